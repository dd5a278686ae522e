// Processes that are killed while they write.
#include "catch.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "image/layered_image.h"
#include "process.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

constexpr int kills = 40;
constexpr int frames = 30;

std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder, const std::string& ending) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().string().ends_with(ending)) {
            files.push_back(entry.path());
        }
    }
    return files;
}

}  // namespace

TEST_CASE("a kill at any time leaves every picture whole, and its leftovers go with the next render", "[app][nightly]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::filesystem::path out = folder.path() / "out";
    std::filesystem::create_directory(out);
    const std::vector<std::string> render = {"render", scene, "-o", (out / "a.##.exr").string(), "--frames",
                                             std::to_string(frames), "--orbit", "1", "--spp", "1", "--size", "256",
                                             "--max-depth", "1"};
    std::size_t read = 0, left_behind = 0;
    for (int kill = 0; kill < kills; ++kill) {
        Process process(folder, render);
        std::this_thread::sleep_for(std::chrono::milliseconds(200 + 37 * kill));
        process.send(SIGKILL);
        process.finish();
        left_behind = std::max(left_behind, files_of(out, ".diptych-part").size());
        for (const std::filesystem::path& file : files_of(out, ".exr")) {
            INFO(file);
            CHECK(read_image(file).color.width == 256);
            ++read;
        }
    }
    CHECK(read > kills);
    INFO("at most " << left_behind << " temporary files were left behind");
    CHECK(left_behind <= 1);  // each run sweeps those before it
    REQUIRE(run_diptych(folder, {"render", scene, "-o", (out / "last.exr").string(), "--spp", "1", "--size", "8"})
                .exit_code == 0);
    CHECK(files_of(out, ".diptych-part").empty());
}
