#include "process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "skipping.h"

namespace diptych::core::tests {

namespace {

std::atomic<int> process_count = 0;

void redirect(const std::filesystem::path& path, int descriptor) {
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || dup2(file, descriptor) < 0) {
        _exit(126);
    }
    close(file);
}

[[noreturn]] void become_program(std::vector<std::string> words, const std::vector<std::string>& environment) {
    for (const std::string& entry : environment) {
        const std::size_t equals = entry.find('=');
        setenv(entry.substr(0, equals).c_str(), entry.substr(equals + 1).c_str(), 1);
    }
    std::vector<char*> pointers;
    for (std::string& word : words) {
        pointers.push_back(word.data());
    }
    pointers.push_back(nullptr);
    execv(pointers[0], pointers.data());
    _exit(127);
}

/// Whether a program that this process started has a handler for the signal. Until it runs, it shows this process's own.
bool catches(int process, int signal) {
    const std::filesystem::path folder = "/proc/" + std::to_string(process);
    std::error_code gone;
    const std::filesystem::path program = std::filesystem::read_symlink(folder / "exe", gone);
    if (gone || program == std::filesystem::read_symlink("/proc/self/exe")) {
        return false;
    }
    std::ifstream status(folder / "status");
    for (std::string word; status >> word;) {
        if (std::uint64_t mask = 0; word == "SigCgt:" && status >> std::hex >> mask) {
            return (mask >> static_cast<unsigned>(signal - 1) & 1U) != 0;
        }
    }
    return false;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "diptych-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
        throw std::runtime_error("no temporary folder " + name);
    }
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

Process::Process(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                 const std::vector<std::string>& environment, const std::string& program) {
    const std::string number = std::to_string(process_count++);
    out_ = folder.file("stdout." + number);
    err_ = folder.file("stderr." + number);
    std::vector<std::string> words = {program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    child_ = fork();
    if (child_ == 0) {
        redirect(out_, STDOUT_FILENO);
        redirect(err_, STDERR_FILENO);
        become_program(std::move(words), environment);
    }
    if (child_ < 0) {
        throw std::runtime_error("cannot start the program");
    }
}

Process::~Process() {
    if (!ended()) {
        kill(child_, SIGKILL);
        waitpid(child_, &status_, 0);
    }
}

bool Process::ended() {
    reaped_ = reaped_ || waitpid(child_, &status_, WNOHANG) == child_;
    return reaped_;
}

bool Process::wait_for(const std::function<bool()>& happened, double seconds) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < deadline) {
        const bool over = ended();
        if (happened()) {
            return true;
        }
        if (over) {
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
}

bool Process::wait_for_error_text(const std::string& text, double seconds) {
    return wait_for([&] { return file_text(err_).find(text) != std::string::npos; }, seconds);
}

bool Process::wait_for_handler(int signal, double seconds) {
    return wait_for([&] { return catches(child_, signal); }, seconds);
}

void Process::send(int signal) {
    kill(child_, signal);
}

ProcessResult Process::finish() {
    if (!reaped_) {
        waitpid(child_, &status_, 0);
        reaped_ = true;
    }
    ProcessResult result;
    result.exit_code = WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
    result.out = file_text(out_);
    result.err = file_text(err_);
    return result;
}

ProcessResult run_diptych(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                          const std::vector<std::string>& environment, const std::string& program) {
    return Process(folder, arguments, environment, program).finish();
}

namespace {

ProcessResult probe_vulkan(const char* validation) {
    const TemporaryFolder folder;
    return run_diptych(folder,
                       {"render", write_bare_triangle(folder), "-o", folder.file("probe.exr"), "--spp", "1", "--size",
                        "4", "--backend", "vulkan"},
                       {std::string("DIPTYCH_VALIDATION=") + validation});
}

}  // namespace

bool program_has_vulkan() {
    static const bool has = probe_vulkan("0").exit_code == 0;
    return has;
}

bool program_has_validation() {
    static const bool has = program_has_vulkan() && probe_vulkan("1").err.find("is not installed") == std::string::npos;
    return has;
}

std::vector<std::string> validation_environment() {
    if (!program_has_validation()) {
        report_left_out("what the Vulkan validation layer would say of the program");
        return {};
    }
    return {"DIPTYCH_VALIDATION=1"};
}

std::string generate_scene(const TemporaryFolder& folder, const std::string& name) {
    const std::string path = folder.file(name + ".glb");
    const ProcessResult result = run_diptych(folder, {"generate", name, "-o", path});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return path;
}

std::string write_bare_triangle(const TemporaryFolder& folder) {
    const std::string path = folder.file("triangle.gltf");
    write_text(path, R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    return path;
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::vector<std::string> words_of(const std::string& command) {
    std::istringstream stream(command);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) {
        words.push_back(word);
    }
    return words;
}

std::vector<std::string> with(std::vector<std::string> base, const std::vector<std::string>& more) {
    base.insert(base.end(), more.begin(), more.end());
    return base;
}

std::string file_text(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

double seconds_taken(double seconds, const std::function<ProcessResult()>& run) {
    double taken = 0;
    for (int trial = 0; trial < 5 && std::abs(taken - seconds) > 0.05 * seconds; ++trial) {
        const ProcessResult result = run();
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        taken = nlohmann::json::parse(result.out).at("seconds").get<double>();
        CHECK(taken > 0.95 * seconds);
    }
    return taken;
}

void check_refusal(const ProcessResult& result, int exit_code, const std::vector<std::string>& parts) {
    INFO("stdout: " << result.out);
    INFO("stderr: " << result.err);
    CHECK(result.exit_code == exit_code);
    CHECK(result.out.empty());
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    for (const std::string& part : parts) {
        INFO("expected: " << part);
        CHECK(result.err.find(part) != std::string::npos);
    }
}

}  // namespace diptych::core::tests
