// What the program answers to input that it cannot use: one line that names the file, and nothing of other libraries.
#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <sys/stat.h>

#include "catch.h"

#include "process.h"

using namespace diptych::core::tests;

namespace {

namespace fs = std::filesystem;

fs::path asset_folder() {
    const char* const given = std::getenv("DIPTYCH_ASSETS");
    return given != nullptr ? fs::path(given) : fs::path(DIPTYCH_SOURCE_DIR) / "../shared/assets";
}

/// Scenes by `info`, pictures by `compare` with themselves: each loads, with warnings at most, or is refused in one
/// line that names the file. The number of refusals.
int refusals_in(const fs::path& input) {
    const TemporaryFolder folder;
    std::set<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(input)) {
        files.insert(entry.path());
    }
    const std::set<std::string> scenes = {".gltf", ".glb"};
    const std::set<std::string> pictures = {".exr", ".hdr", ".png", ".jpg", ".webp", ".ktx2"};
    int refused = 0;
    for (const fs::path& file : files) {
        const std::string name = file.string();
        std::vector<std::string> arguments;
        if (scenes.count(file.extension().string()) > 0) {
            arguments = {"info", name};
        } else if (pictures.count(file.extension().string()) > 0) {
            arguments = {"compare", name, name};
        } else {
            continue;
        }
        const ProcessResult result = run_diptych(folder, arguments);
        INFO(name << "\nstdout: " << result.out << "\nstderr: " << result.err);
        if (result.exit_code == 0) {
            std::istringstream lines(result.err);
            for (std::string line; std::getline(lines, line);) {
                CHECK((line.rfind("diptych: ", 0) == 0 && contains(line, name)));
            }
        } else {
            check_refusal(result, 2, {"diptych: " + name + ": "});
            ++refused;
        }
    }
    return refused;
}

}  // namespace

TEST_CASE("found broken files are refused in one line that names them", "[app]") {
    if (!fs::exists(asset_folder() / "found/broken")) {
        SKIP_TEST("no assets at " + asset_folder().string());
    }
    // All but ty-texcoord9.gltf, of which a texture is left out.
    CHECK(refusals_in(asset_folder() / "found/broken") == 23);
}

TEST_CASE("every invalid asset is answered by the program", "[app][nightly]") {
    if (!fs::exists(asset_folder() / "invalid")) {
        SKIP_TEST("no assets at " + asset_folder().string());
    }
    CHECK(refusals_in(asset_folder() / "invalid") > 100);
}

TEST_CASE("pipes and folders are refused before they are read, whatever the input", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string pipe = folder.file("pipe"), out = folder.file("out.exr"), state = folder.file("converged");
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    for (const std::string& name : {pipe, folder.path().string()}) {
        const std::string reason = name == pipe ? "it is a device or a pipe" : "it is a folder";
        check_refusal(run_diptych(folder, {"info", name}), 2, {name, reason});
        check_refusal(run_diptych(folder, {"render", scene, "-o", out, "--env", name}), 2, {name, reason});
        check_refusal(run_diptych(folder, {"compare", name, name}), 2, {name, reason});
        const ProcessResult converged = run_diptych(
            folder, {"converge", scene, "--methods", "cpu:path", "--reference", name, "--size", "8", "-o", state});
        check_refusal(converged, 2, {name, reason});
    }
    fs::create_directory(state);
    REQUIRE(mkfifo((state + "/plan.json").c_str(), 0600) == 0);
    check_refusal(run_diptych(folder, {"converge", scene, "--methods", "cpu:path", "--size", "8", "-o", state}), 2,
                  {state + "/plan.json", "it is a device or a pipe"});
}

TEST_CASE("an empty text is refused by the name of its option", "[app]") {
    const TemporaryFolder folder;
    const std::string out = folder.file("out.exr");
    for (const char* option : {"--camera", "--env", "--clip", "--size", "--device", "--sampler", "--eye", "--sun",
                               "--memory-limit", "--seed", "--ignore-extension"}) {
        INFO(option);
        check_refusal(run_diptych(folder, {"render", "a.gltf", "-o", out, option, ""}), 2, {option, "empty"});
    }
    check_refusal(run_diptych(folder, {"render", "a.gltf", "-o", ""}), 2, {"--output", "empty"});
    check_refusal(run_diptych(folder, {"info", ""}), 2, {"scene", "empty"});
    check_refusal(run_diptych(folder, {"compare", "a.exr", ""}), 2, {"b", "empty"});
}

TEST_CASE("whole numbers are decimal", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const auto command_of = [&](const std::string& seed, const std::string& spp) {
        const ProcessResult result = run_diptych(folder, {"render", scene, "-o", folder.file("out.exr"), "--size", "4",
                                                          "--spp", spp, "--seed", seed, "--json"});
        CHECK(result.exit_code == 0);
        return result.out;
    };
    CHECK(contains(command_of("0010", "08"), "--seed 10"));
    CHECK(contains(command_of("7", "010"), "--spp 10"));
}

TEST_CASE("a broken picture is refused without a line of libpng", "[app]") {
    const TemporaryFolder folder;
    const std::string name = folder.file("broken.png");
    // 8x8 pixels whose compressed data is no deflate stream.
    write_text(name, std::string("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x08\0\0\0\x08\x08\x02\0\0\0\x4b\x6d\x29\xdc"
                                 "\0\0\0\x04IDATxxxx\xa7\x72\x5c\x6c\0\0\0\0IEND\xae\x42\x60\x82",
                                 61));
    check_refusal(run_diptych(folder, {"compare", name, name}), 2, {"diptych: " + name + ": cannot read: "});
}

TEST_CASE("a file that asks for too much memory is refused by --memory-limit", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell"), out = folder.file("out.exr");
    check_refusal(run_diptych(folder, {"info", scene, "--memory-limit", "1K"}), 2,
                  {scene, "asks for", "a file may ask for 1.0 KB (--memory-limit)"});
    check_refusal(run_diptych(folder, {"info", scene, "--memory-limit", "much"}), 2,
                  {"--memory-limit", "no amount of memory"});
    // A Radiance picture in the newer encoding: 12 bytes a scanline of 100 pixels, one run a channel.
    std::string sky = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 40 +X 100\n";
    for (int line = 0; line < 40; ++line) {
        sky += std::string("\2\2\0\x64", 4);
        for (int channel = 0; channel < 4; ++channel) {
            sky += "\xe4\x80";
        }
    }
    const std::string name = folder.file("sky.hdr");
    write_text(name, sky);
    check_refusal(run_diptych(folder, {"render", scene, "-o", out, "--env", name, "--memory-limit", "90K"}), 2,
                  {"environment map " + name, "asks for 93.8 KB", "--memory-limit"});
    check_refusal(run_diptych(folder, {"compare", name, name, "--memory-limit", "90K"}), 2, {name, "--memory-limit"});
    CHECK(run_diptych(folder, {"compare", name, name}).exit_code == 0);
}

TEST_CASE("a film with sums that asks for too much memory is refused by --memory-limit", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell"), out = folder.file("out.exr");
    const std::string part = folder.file("part.exr");
    const std::vector<std::string> render = {"render", scene, "--backend", "cpu", "--size", "96x64"};
    REQUIRE(run_diptych(folder, with(render, {"--samples", "0:1", "-o", part})).exit_code == 0);
    const std::vector<std::string> refused = {part + ": cannot read its film: asks for 1.4 MB",
                                              "a file may ask for 1.0 MB (--memory-limit)"};
    check_refusal(run_diptych(folder, {"merge", part, "-o", out, "--memory-limit", "1M"}), 2, refused);
    check_refusal(
        run_diptych(folder, with(render, {"--spp", "2", "-o", out, "--resume", part, "--memory-limit", "1M"})), 2, refused);
    CHECK_FALSE(std::filesystem::exists(out));
    CHECK(run_diptych(folder, {"merge", part, "-o", out, "--memory-limit", "2M"}).exit_code == 0);
}
