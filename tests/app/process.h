// The program as a black box.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "catch.h"

namespace diptych::core::tests {

struct ProcessResult {
    int exit_code = -1;  // 128 + the signal where one killed it
    std::string out;
    std::string err;
};

/// A folder that goes when the test does.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::string file(const std::string& name) const { return (path_ / name).string(); }

private:
    std::filesystem::path path_;
};

/// A run of the program that goes on beside the test.
class Process {
public:
    /// `environment` holds NAME=VALUE entries on top of the test's own; stdout and stderr go to files in the folder.
    Process(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
            const std::vector<std::string>& environment = {}, const std::string& program = DIPTYCH_PROGRAM);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// Waits until stderr holds `text`; false after `seconds` or when the program ended without it.
    bool wait_for_error_text(const std::string& text, double seconds);
    /// Waits until the program has a handler for the signal; false after `seconds` or when the program ended without one.
    bool wait_for_handler(int signal, double seconds);
    void send(int signal);
    ProcessResult finish();
    int id() const { return child_; }

private:
    bool ended();
    /// Waits for what `happened` tells; false after `seconds` or when the program ended without it.
    bool wait_for(const std::function<bool()>& happened, double seconds);

    std::filesystem::path out_;
    std::filesystem::path err_;
    int child_ = -1;
    int status_ = 0;
    bool reaped_ = false;
};

/// Whether the program renders on a Vulkan device here.
bool program_has_vulkan();
/// Whether it does so under the validation layer.
bool program_has_validation();
/// Puts the program under the validation layer where that is installed; says LEFT OUT where it is not.
std::vector<std::string> validation_environment();

ProcessResult run_diptych(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                          const std::vector<std::string>& environment = {},
                          const std::string& program = DIPTYCH_PROGRAM);

/// `diptych generate NAME` into the folder; the path of the .glb.
std::string generate_scene(const TemporaryFolder& folder, const std::string& name);

/// A .gltf of one grey triangle in the plane z = 0: neither light nor camera.
std::string write_bare_triangle(const TemporaryFolder& folder);

bool contains(const std::string& text, const std::string& part);
/// The words of a command line without quotes.
std::vector<std::string> words_of(const std::string& command);
/// `base` with `more` behind it.
std::vector<std::string> with(std::vector<std::string> base, const std::vector<std::string>& more);

std::string file_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);

/// How long a run says, by --json, that it took: of a few runs, as other load on the machine may hold one up, the first
/// that takes `seconds` within five percent, else the last. None may stop short.
double seconds_taken(double seconds, const std::function<ProcessResult()>& run);

/// The refusal that a user is owed: exit code, nothing on stdout, one line on stderr that holds every one of the parts.
void check_refusal(const ProcessResult& result, int exit_code, const std::vector<std::string>& parts);

}  // namespace diptych::core::tests

/// Leaves the test case where the program has no device.
#define NEED_PROGRAM_WITH_VULKAN()                                                                                     \
    do {                                                                                                               \
        if (!diptych::core::tests::program_has_vulkan()) {                                                             \
            SKIP_TEST("no Vulkan device with ray tracing, or built without Vulkan");                                   \
        }                                                                                                              \
    } while (false)
