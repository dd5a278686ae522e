// Sequences: names, times, metadata, interrupts.
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>

#include <fmt/format.h>

#include "catch.h"
#include "image/layered_image.h"
#include "process.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

ProcessResult render_sequence(const TemporaryFolder& folder, const std::string& scene, const std::string& output,
                              const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render", scene, "-o", folder.file(output), "--size", "24x18", "--spp", "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessResult result = run_diptych(folder, arguments);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return result;
}

std::vector<std::string> words_after_program(const std::string& command) {
    std::istringstream stream(command);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) {
        words.push_back(word);
    }
    words.erase(words.begin());
    return words;
}

}  // namespace

TEST_CASE("a sequence is one file a frame, and each repeats alone to the bit", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "moving-light");
    const ProcessResult result =
        render_sequence(folder, scene, "walk.exr",
               {"--frames", "3", "--fps", "3", "--start", "0.9", "--camera", "moving", "--seed", "5", "--json"});
    const auto list = nlohmann::json::parse(result.out);
    REQUIRE(list.size() == 3);
    CHECK_FALSE(std::filesystem::exists(folder.file("walk.exr")));
    std::vector<LayeredImage> frames;
    for (int i = 0; i < 3; ++i) {
        INFO(i);
        const std::string file = folder.file("walk.000" + std::to_string(i) + ".exr");
        const auto& json = list[static_cast<std::size_t>(i)];
        CHECK(json.at("output") == file);
        CHECK(json.at("frame") == i);
        CHECK(json.at("time").get<double>() == Approx(0.9 + i / 3.0));
        CHECK(json.at("move_seconds").get<double>() >= 0);
        frames.push_back(read_image(file));
        CHECK(frames.back().metadata.at("frame") == std::to_string(i));
        CHECK(frames.back().metadata.at("seed") == std::to_string(5 + i));
    }
    CHECK(frames[0].color.data != frames[1].color.data);
    const std::string command = frames[1].metadata.at("command");
    std::filesystem::remove(folder.file("walk.0001.exr"));
    const ProcessResult again = run_diptych(folder, words_after_program(command));
    INFO(command << "\n" << again.err);
    REQUIRE(again.exit_code == 0);
    const LayeredImage alone = read_image(folder.file("walk.0001.exr"));
    CHECK(alone.color.data == frames[1].color.data);
    CHECK(alone.depth->data == frames[1].depth->data);
    CHECK(alone.metadata.at("command") == command);
}

TEST_CASE("the frame's number goes where # stands, and a time alone is one picture", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "moving-light");
    render_sequence(folder, scene, "a.##.b.png", {"--frames", "2"});
    CHECK(std::filesystem::exists(folder.file("a.00.b.png")));
    CHECK(std::filesystem::exists(folder.file("a.01.b.png")));
    const ProcessResult one = render_sequence(folder, scene, "one.png", {"--start", "1.5"});
    CHECK(std::filesystem::exists(folder.file("one.png")));
    CHECK(one.err.find("at rest") == std::string::npos);
    CHECK(render_sequence(folder, scene, "rest.png", {}).err.find("at rest") != std::string::npos);
}

TEST_CASE("an orbit turns the camera, by as much at a time whichever frame shows it", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    render_sequence(folder, scene, "around.exr", {"--frames", "3", "--fps", "2", "--orbit", "20"});
    render_sequence(folder, scene, "still.exr", {});
    const LayeredImage first = read_image(folder.file("around.0000.exr"));
    CHECK(first.color.data == read_image(folder.file("still.exr")).color.data);
    const LayeredImage third = read_image(folder.file("around.0002.exr"));
    CHECK(third.color.data != first.color.data);
    render_sequence(folder, scene, "alone.exr", {"--start", "1", "--fps", "2", "--orbit", "20", "--seed", "2"});
    CHECK(read_image(folder.file("alone.exr")).color.data == third.color.data);
}

TEST_CASE("an interrupt leaves the finished frames and saves the one it met", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "moving-light");
    Process process(folder, {"render", scene, "-o", folder.file("long.exr"), "--size", "32", "--frames", "100000",
                             "--time", "0.3"});
    // The line of the second frame comes after the first one's file.
    const bool begun = process.wait_for_error_text("frame 2/100000", 60);
    process.send(SIGINT);
    const ProcessResult result = process.finish();
    CHECK(begun);
    CHECK(result.exit_code == 130);
    int frame = 0;
    const auto file = [&](const char* ending) { return folder.file(fmt::format("long.{:04}{}", frame, ending)); };
    for (; std::filesystem::exists(file(".exr")); ++frame) {
        CHECK(read_image(file(".exr")).metadata.at("interrupted") == "no");
    }
    CHECK(frame > 0);
    if (std::filesystem::exists(file(".part.exr"))) {  // not where the interrupt came between two frames
        CHECK(read_image(file(".part.exr")).metadata.at("frame") == std::to_string(frame));
    }
}

TEST_CASE("options of sequences that make no sense are refused", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "moving-light");
    const auto refuse = [&](const std::vector<std::string>& more, const std::string& part) {
        std::vector<std::string> arguments = {"render", scene, "-o", folder.file("no.exr")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        check_refusal(run_diptych(folder, arguments), 2, {part});
    };
    refuse({"--fps", "24"}, "--fps");
    refuse({"--frames", "0"}, "--frames");
    refuse({"--frames", "2", "--fps", "0"}, "--fps");
    refuse({"--frames", "2", "--start", "-1"}, "--start");
    refuse({"--orbit", "nan"}, "--orbit");
}
