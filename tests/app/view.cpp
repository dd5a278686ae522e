// `diptych view` without a window, and the viewpoints and suns by which its pictures are repeated.
#include "catch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "image/image_file.h"
#include "image/layered_image.h"
#include "process.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// Share of the values that differ by more than a thousandth: paths that rounding has parted.
double parted(const Image& a, const Image& b) {
    REQUIRE(a.data.size() == b.data.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.data.size(); ++i) {
        count += std::abs(a.data[i] - b.data[i]) > 1e-3F * (1e-3F + std::abs(a.data[i])) ? 1 : 0;
    }
    return static_cast<double>(count) / static_cast<double>(a.data.size());
}

double mean(const Image& image) {
    double sum = 0;
    for (const float value : image.data) {
        sum += static_cast<double>(value);
    }
    return sum / static_cast<double>(image.data.size());
}

/// Means of the left and the right half.
std::array<double, 2> half_means(const Image& image) {
    std::array<double, 2> sums{};
    for (std::size_t i = 0; i < image.data.size(); ++i) {
        const std::size_t column = i / static_cast<std::size_t>(image.channels) % static_cast<std::size_t>(image.width);
        sums[2 * column < static_cast<std::size_t>(image.width) ? 0 : 1] += static_cast<double>(image.data[i]);
    }
    const double count = static_cast<double>(image.data.size()) / 2;
    return {sums[0] / count, sums[1] / count};
}

/// Renders the words with other ones at their end, to another file.
Image render(const TemporaryFolder& folder, std::vector<std::string> words, const std::string& file) {
    words.insert(words.end(), {"-o", folder.file(file)});
    const ProcessResult result = run_diptych(folder, words);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return read_image(folder.file(file)).color;
}

}  // namespace

TEST_CASE("a view without a window times its frames and keeps the last", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const ProcessResult result =
        run_diptych(folder, {"view", scene, "--headless", "--panel", "cpu", "--frames", "12", "--size", "48x32",
                             "--max-depth", "2", "--json", "-o", folder.file("last.exr")});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out);
    for (const char* kind : {"moving", "resting"}) {
        CHECK(json.at(kind).at("frames") == 6);
        CHECK(json.at(kind).at("median_ms") > 0);
        CHECK(json.at(kind).at("p95_ms") >= json.at(kind).at("median_ms"));
        CHECK(json.at(kind).at("samples") >= 1);
        CHECK(json.at(kind).at("divisor") >= 1);
    }
    CHECK(json.at("resting").at("divisor") == 1);
    CHECK(json.at("panels")[0].at("backend") == "cpu");
    // What it saved is what its command renders, up to where the scene was centred.
    const LayeredImage last = read_image(folder.file("last.exr"));
    CHECK(last.color.width == 48);
    std::vector<std::string> words = words_of(last.metadata.at("command"));
    words.erase(words.begin());
    INFO(last.metadata.at("command"));
    CHECK(last.metadata.at("command").find("--eye ") != std::string::npos);
    const auto output = std::find(words.begin(), words.end(), "-o");
    REQUIRE(output != words.end());
    *(output + 1) = folder.file("again.exr");
    const ProcessResult again = run_diptych(folder, words);
    INFO(again.err);
    REQUIRE(again.exit_code == 0);
    const Image repeated = read_image(folder.file("again.exr")).color;
    CHECK(parted(last.color, repeated) < 0.01);
    CHECK(mean(last.color) == Approx(mean(repeated)).epsilon(1e-3));
}

TEST_CASE("a view of both panels compares them, and saves what it shows", "[app]") {
    NEED_PROGRAM_WITH_VULKAN();
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const auto view = [&](const std::string& panel) {
        return run_diptych(folder,
                           {"view", scene, "--headless", "--panel", panel, "--frames", "8", "--size", "48x32",
                            "--max-depth", "2", "--json", "-o", folder.file(panel + ".png")},
                           validation_environment());
    };
    const ProcessResult result = view("split");
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK(result.err.empty());
    const auto json = nlohmann::json::parse(result.out);
    CHECK(json.at("panels").size() == 2);
    REQUIRE(view("cpu").exit_code == 0);
    const Image split = read_image(folder.file("split.png")).color;
    CHECK(split.width == 48);
    // The same room, whichever panel shows a half of it, but for noise.
    const std::array<double, 2> both = half_means(split);
    const std::array<double, 2> cpu = half_means(read_image(folder.file("cpu.png")).color);
    CHECK(both[0] > 0);
    CHECK(both[0] == Approx(cpu[0]).epsilon(0.2));
    CHECK(both[1] == Approx(cpu[1]).epsilon(0.2));
}

TEST_CASE("view refuses what it cannot show", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const auto refused = [&](std::vector<std::string> more, const std::vector<std::string>& parts) {
        more.insert(more.begin(), {"view", scene});
        check_refusal(run_diptych(folder, more), 2, parts);
    };
    refused({"--headless", "--panel", "both"}, {"--panel both", "vulkan, cpu, split, difference"});
    refused({"--headless", "--atlas", "8", "--integrator", "ris"}, {"--atlas"});
    refused({"--headless", "--sampler", "hammersley"}, {"--sampler hammersley"});
    refused({"--headless", "--frames", "1"}, {"--frames"});
    refused({"--headless", "-o", folder.file("no/last.png")}, {"no/last.png"});
    refused({"--headless", "--log", "-"}, {"--log", "window"});
    refused({"--frames", "4"}, {"--frames", "--headless"});
    check_refusal(run_diptych(folder, {"view", folder.file("none.gltf"), "--headless"}), 2, {"none.gltf"});
}

TEST_CASE("a viewpoint and a sun change the picture as they say", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::vector<std::string> plain = {"render", scene, "--spp", "4", "--size", "24x24", "--max-depth", "1"};
    const auto with = [&](std::vector<std::string> more, const std::string& file) {
        more.insert(more.begin(), plain.begin(), plain.end());
        return render(folder, more, file);
    };
    const Image seen = with({}, "plain.exr");
    // A wall from outside shows its back: the lamp is not seen, and nothing lights it.
    const Image outside = with({"--eye", "0,1,20", "--look-at", "0,1,30"}, "away.exr");
    CHECK(mean(outside) == 0);
    CHECK(mean(with({"--eye", "0,1,20", "--look-at", "0,1,30", "--env", "1,1,1"}, "sky.exr")) == Approx(1));
    CHECK(mean(with({"--fov", "10"}, "narrow.exr")) != Approx(mean(seen)).epsilon(1e-3));
    // Straight from in front, into the open room.
    const double sunny = mean(with({"--sun", "0,10,20"}, "sun.exr"));
    CHECK(sunny > 1.05 * mean(seen));
    CHECK(mean(with({"--sun", "0,10,0"}, "night.exr")) == Approx(mean(seen)).epsilon(0.05));
}
