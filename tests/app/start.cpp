// What a start costs, and where the library for image files is found.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <regex>
#include <sstream>

#include "catch.h"
#include "process.h"
#include "sanitized.h"
#include "skipping.h"

using namespace diptych::core::tests;

namespace {

namespace fs = std::filesystem;

constexpr const char* library_name = "libdiptych_images.so";
const fs::path program = DIPTYCH_PROGRAM;

struct StartCost {
    double seconds = 0;
    long kilobytes = 0;  // the largest resident set
};

StartCost start_cost(const char* option) {
    const auto start = std::chrono::steady_clock::now();
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        if (freopen("/dev/null", "w", stdout) == nullptr) {
            _exit(126);
        }
        execl(program.c_str(), program.c_str(), option, nullptr);
        _exit(127);
    }
    int status = -1;
    rusage usage{};
    REQUIRE(wait4(child, &status, 0, &usage) == child);
    REQUIRE(status == 0);
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), usage.ru_maxrss};
}

/// The libraries that the dynamic linker loads at the start, as it lists them.
std::vector<std::string> libraries_at_start(const TemporaryFolder& folder) {
    std::istringstream list(run_diptych(folder, {}, {"LD_TRACE_LOADED_OBJECTS=1"}).out);
    std::vector<std::string> lines;
    for (std::string line; std::getline(list, line);) {
        lines.push_back(line);
    }
    return lines;
}

bool any_holds(const std::vector<std::string>& lines, const std::string& part) {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

/// A copy of the program, in a folder that does not have the library.
fs::path copied_program(const TemporaryFolder& folder) {
    const fs::path bin = folder.path() / "bin";
    fs::create_directories(bin);
    fs::copy_file(program, bin / "diptych");
    return bin / "diptych";
}

/// As PNG, which the library writes; EXR does without it.
ProcessResult render(const TemporaryFolder& folder, const fs::path& by,
                     const std::vector<std::string>& environment = {}, const std::string& picture = "picture.png") {
    return run_diptych(folder,
                       {"render", write_bare_triangle(folder), "-o", folder.file(picture), "--spp", "1", "--size", "4",
                        "--backend", "cpu"},
                       environment, by.string());
}

void check_renders(const ProcessResult& result) {
    INFO(result.err);
    CHECK(result.exit_code == 0);
}

}  // namespace

TEST_CASE("the program starts within 100 ms and 25 MB", "[app][timed]") {
    if (sanitized) {
        SKIP_TEST("sanitizers take time and memory of their own");
    }
    for (const char* option : {"--version", "--help"}) {
        INFO(option);
        StartCost best = start_cost(option);
        for (int trial = 1; trial < 5; ++trial) {
            const StartCost cost = start_cost(option);
            best = {std::min(best.seconds, cost.seconds), std::min(best.kilobytes, cost.kilobytes)};
        }
        CHECK(best.seconds < 0.1);
        CHECK(best.kilobytes < 25'000);
    }
}

TEST_CASE("the program does not load OpenImageIO at the start", "[app]") {
    const TemporaryFolder folder;
    const std::vector<std::string> libraries = libraries_at_start(folder);
    CHECK(any_holds(libraries, "libembree"));  // so the list is one
    CHECK_FALSE(any_holds(libraries, "OpenImageIO"));
    CHECK_FALSE(any_holds(libraries, "OpenEXR"));
    CHECK_FALSE(any_holds(libraries, library_name));
    CHECK(libraries.size() < 50);
}

TEST_CASE("the library for image files is found beside the program, in ../lib and in LD_LIBRARY_PATH", "[app]") {
    const fs::path library = program.parent_path() / library_name;
    SECTION("beside the program") {
        const TemporaryFolder folder;
        const fs::path copy = copied_program(folder);
        fs::copy_file(library, copy.parent_path() / library_name);
        check_renders(render(folder, copy));
    }
    SECTION("in the lib folder beside the program's") {
        const TemporaryFolder folder;
        const fs::path copy = copied_program(folder);
        fs::create_directory(folder.path() / "lib");
        fs::copy_file(library, folder.path() / "lib" / library_name);
        check_renders(render(folder, copy));
    }
    SECTION("in a folder of LD_LIBRARY_PATH") {
        const TemporaryFolder folder, elsewhere;
        const fs::path copy = copied_program(folder);
        fs::copy_file(library, elsewhere.path() / library_name);
        check_renders(render(folder, copy, {"LD_LIBRARY_PATH=" + elsewhere.path().string()}));
    }
}

TEST_CASE("a library for image files of another build is refused by name", "[app]") {
    const TemporaryFolder folder;
    const fs::path copy = copied_program(folder);
    std::string bytes = file_text(program.parent_path() / library_name);
    // The version and the digest of the interface, as in 0.1.0-1a2b3c4d.
    std::smatch interface;
    REQUIRE(std::regex_search(bytes, interface, std::regex("[0-9]+\\.[0-9]+\\.[0-9]+-[0-9a-f]{8}")));
    const auto last = static_cast<std::size_t>(interface.position() + interface.length() - 1);
    bytes[last] = bytes[last] == '0' ? '1' : '0';
    write_text(copy.parent_path() / library_name, bytes);
    check_refusal(render(folder, copy), 2, {library_name, "another build"});
}

TEST_CASE("without the library for image files, what needs none works and the rest is refused before it starts",
          "[app]") {
    const TemporaryFolder folder;
    const fs::path copy = copied_program(folder);
    const auto run = [&](const std::vector<std::string>& arguments) {
        return run_diptych(folder, arguments, {}, copy.string());
    };
    CHECK(run({"--version"}).exit_code == 0);
    CHECK(run({"info", write_bare_triangle(folder)}).exit_code == 0);
    check_renders(render(folder, copy, {}, "picture.exr"));
    check_refusal(render(folder, copy), 2, {"picture.png: cannot write", library_name, "No such file"});
    CHECK_FALSE(fs::exists(folder.path() / "picture.png"));
    const std::string scenes = std::string(DIPTYCH_SOURCE_DIR) + "/scenes/";
    check_refusal(run({"info", scenes + "normal-map.gltf"}), 2, {library_name, "No such file"});
    check_refusal(run({"generate", "normal-map", "-o", folder.file("a.gltf")}), 2, {library_name, "No such file"});
    const std::string png = scenes + "normal-map-color.png";
    check_refusal(run({"compare", png, png}), 2, {"normal-map-color.png: cannot read", library_name});
}

TEST_CASE("the library beside the program goes before one in LD_LIBRARY_PATH", "[app]") {
    const TemporaryFolder folder, elsewhere;
    const fs::path copy = copied_program(folder);
    fs::copy_file(program.parent_path() / library_name, copy.parent_path() / library_name);
    std::ofstream(elsewhere.path() / library_name) << "of another version";
    check_renders(render(folder, copy, {"LD_LIBRARY_PATH=" + elsewhere.path().string()}));
}

TEST_CASE("another library under that name is refused", "[app]") {
    const TemporaryFolder folder;
    const fs::path copy = copied_program(folder);
    for (const std::string& line : libraries_at_start(folder)) {  // "	libfmt.so.9 => /lib/libfmt.so.9 (0x...)"
        const std::size_t path = line.find("=> /");
        if (path != std::string::npos && line.find("libfmt") != std::string::npos) {
            fs::copy_file(line.substr(path + 3, line.rfind(" (") - path - 3), copy.parent_path() / library_name);
        }
    }
    REQUIRE(fs::exists(copy.parent_path() / library_name));
    check_refusal(render(folder, copy), 2, {"picture.png", library_name, "another build"});
}
