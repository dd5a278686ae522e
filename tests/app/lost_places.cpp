// Places to write to that fill up or vanish while a render works.
#include "catch.h"

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>

#include "image/layered_image.h"
#include "process.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

constexpr const char* unshare = "/usr/bin/unshare";

bool can_mount(const TemporaryFolder& folder) {
    return std::filesystem::exists(unshare) &&
           run_diptych(folder, {"-m", "mount", "-t", "tmpfs", "tmpfs", folder.file("disk")}, {}, unshare).exit_code == 0;
}

/// What the script says, run in /bin/sh with a disk of 200 kB mounted on "disk" in the folder. $R renders the scene.
ProcessResult on_small_disk(const TemporaryFolder& folder, const std::string& scene, const std::string& script) {
    const std::string render = std::string(DIPTYCH_PROGRAM) + " render " + scene + " --spp 1 --backend cpu";
    return run_diptych(folder,
                       {"-m", "/bin/sh", "-c",
                        "cd " + folder.path().string() + " && mount -t tmpfs -o size=200k tmpfs disk && R='" + render +
                            "' && " + script},
                       {}, unshare);
}

}  // namespace

TEST_CASE("a full disk leaves the old picture whole, and the new one goes to --fallback-dir", "[app]") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.file("disk"));
    std::filesystem::create_directory(folder.file("other"));
    if (!can_mount(folder)) {
        SKIP_TEST("a file system cannot be mounted in a namespace of its own");
    }
    const std::string scene = generate_scene(folder, "cornell");
    const ProcessResult result = on_small_disk(folder, scene, R"(
$R -o disk/a.exr --size 16 >say; echo first $?
cp disk/a.exr old.exr
$R -o disk/a.exr --size 128 >say; echo full $?
cmp disk/a.exr old.exr && echo whole
$R -o disk/a.exr --size 128 --fallback-dir other --json; echo fallback $?
$R -o disk/b.exr --size 128 --fallback-dir other --frames 2 >say; echo sequence $?
$R -o disk/a.exr --size 128 --fallback-dir other >say; echo again $?
cmp disk/a.exr old.exr && echo whole
ls -A disk
)");
    INFO(result.out << result.err);
    std::istringstream lines(result.out);
    std::vector<std::string> said;
    nlohmann::json json;
    for (std::string line; std::getline(lines, line);) {
        if (line.front() == '{') {
            json = nlohmann::json::parse(line);
        } else {
            said.push_back(line);
        }
    }
    CHECK(said == std::vector<std::string>{"first 0", "full 2", "whole", "fallback 2", "sequence 2", "again 2", "whole",
                                           "a.exr"});
    CHECK(contains(result.err, "disk/a.exr: cannot write: No space left on device\n"));
    CHECK(contains(result.err, "disk/a.exr: the picture lies in other/a.exr instead\n"));
    CHECK(json.at("output") == "other/a.exr");
    CHECK(json.at("fell_back") == true);
    for (const char* name : {"a.exr", "a-2.exr", "b.0000.exr", "b.0001.exr"}) {
        INFO(name);
        CHECK(read_image(folder.file(std::string("other/") + name)).color.width == 128);
    }
}

TEST_CASE("a folder that vanishes while a render works costs neither its samples nor its signal", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    std::filesystem::create_directory(folder.file("gone"));
    std::filesystem::create_directory(folder.file("other"));
    Process process(folder, {"render", scene, "-o", folder.file("gone/a.exr"), "--spp", "100000000", "--size", "16",
                             "--fallback-dir", folder.file("other")});
    REQUIRE(process.wait_for_error_text("spp", 60));
    std::filesystem::remove_all(folder.file("gone"));
    process.send(SIGTERM);
    const ProcessResult result = process.finish();
    CHECK(result.exit_code == 128 + SIGTERM);
    CHECK(contains(result.err, "cannot write: the folder '" + folder.file("gone") + "' does not exist"));
    CHECK(read_image(folder.file("other/a.part.exr")).metadata.at("interrupted") == "yes");
}

TEST_CASE("ulimit -f is an error with a reason, not a death", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const ProcessResult result =
        run_diptych(folder, {"-c", "ulimit -f 16; exec \"$0\" \"$@\"", DIPTYCH_PROGRAM, "render", scene, "-o",
                             folder.file("a.exr"), "--spp", "1", "--size", "128"},
                    {}, "/bin/sh");
    CHECK(result.exit_code == 2);
    CHECK(contains(result.err, "a.exr: cannot write: File too large"));
    CHECK_FALSE(std::filesystem::exists(folder.file("a.exr")));
}

TEST_CASE("a fallback that is no other place is refused before the work", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = folder.file("missing.gltf");
    const auto refused = [&](const std::string& fallback, const std::string& reason) {
        check_refusal(run_diptych(folder, {"render", scene, "-o", folder.file("a.exr"), "--fallback-dir", fallback}), 2,
                      {"--fallback-dir " + fallback, reason});
    };
    refused(folder.file("no"), "is not a folder");
    refused(folder.path().string() + "/.", "is the folder of -o");
}
