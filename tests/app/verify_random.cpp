#include "catch.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "backend/cpu_renderer.h"
#include "image/layered_image.h"
#include "pack/packed_scene.h"
#include "process.h"
#include "random_scene/scene_files.h"
#include "render/film.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// The largest difference between a picture's pixels and a film's means, relative to the brightest.
double difference(const std::string& picture, const Film& film) {
    const Image read = read_image(picture).color;
    const LayeredImage expected = develop(film);
    double worst = 0;
    double brightest = 0;
    for (int y = 0; y < film.height; ++y) {
        for (int x = 0; x < film.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                const double value = expected.color.at(x, y, c);
                worst = std::max(worst, std::abs(read.at(x, y, c) - value));
                brightest = std::max(brightest, value);
            }
        }
    }
    return worst / brightest;
}

}  // namespace

TEST_CASE("generate random writes a scene that its command line renders as verify judges it", "[app]") {
    for (const std::uint64_t seed : {2U, 5U, 12U}) {
        INFO("seed " << seed);
        const TemporaryFolder folder;
        const std::string file = folder.file("random.gltf");
        const ProcessResult written =
            run_diptych(folder, {"generate", "random", "--seed", std::to_string(seed), "-o", file, "--json"});
        INFO(written.err);
        REQUIRE(written.exit_code == 0);
        const std::string arguments = nlohmann::json::parse(written.out).at("recommended_arguments");
        std::vector<std::string> command{"render", file};
        const std::vector<std::string> words = words_of(arguments);
        command.insert(command.end(), words.begin(), words.end());
        const std::string picture = folder.file("picture.exr");
        command.insert(command.end(), {"--spp", "4", "--seed", "3", "-o", picture});
        const ProcessResult rendered = run_diptych(folder, command);
        INFO(rendered.err);
        REQUIRE(rendered.exit_code == 0);

        const RandomScene random = make_random_scene(seed);
        RenderSettings settings = random.settings;
        settings.seed = 3;
        settings.sample_count = 4;
        const PackedScene packed = pack_scene(read_random_scene(random, file), settings);
        const auto renderer = make_cpu_renderer(packed, 1);
        const std::atomic<bool> cancel{false};
        renderer->render(0, 4, cancel);
        CHECK(difference(picture, renderer->film()) < 1e-6);
    }
}

TEST_CASE("verify judges random scenes and tells the power reached", "[app]") {
    const TemporaryFolder folder;
    const std::vector<std::string> command = {"verify", "--random", "2",          "--seed", "7",    "--backends",
                                              "cpu",    "--json",   "--integrators", "path",   "--runs", "8",
                                              "--max-half-width", "4",  "--still"};
    const ProcessResult result = run_diptych(folder, command);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out);
    CHECK(json.at("verdict") == "PASS");
    CHECK(json.at("scenes") == 2);
    CHECK(json.at("failures").empty());
    REQUIRE(json.at("pairs").size() == 2);
    CHECK(json.at("pairs")[1].at("seed") == 8);
    CHECK(json.at("pairs")[1].at("a") == "cpu/path");
    CHECK(json.at("pairs")[1].at("b") == "oracle/mis");
    const auto& power = json.at("cpu_against_oracle");
    CHECK(power.at("comparisons") == 2);
    CHECK(power.at("worst_half_width_percent").get<double>() >= power.at("median_half_width_percent").get<double>());
    CHECK(power.at("median_half_width_percent").get<double>() > 0);
    CHECK(json.at("vulkan_against_cpu").at("comparisons") == 0);
}

TEST_CASE("verify judges moving random scenes at every frame", "[app]") {
    const TemporaryFolder folder;
    const ProcessResult result =
        run_diptych(folder, {"verify", "--random", "1", "--seed", "302", "--backends", "cpu", "--json", "--integrators",
                             "path,restir", "--runs", "8", "--max-half-width", "8"});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out);
    REQUIRE(json.at("pairs").size() == 6);
    CHECK(json.at("pairs")[0].at("b") == "oracle/mis");
    for (int frame = 0; frame < 5; ++frame) {
        const auto& pair = json.at("pairs")[std::size_t(1 + frame)];
        CHECK(pair.at("frame") == frame);
        CHECK(pair.at("a") == "cpu/restir");
        CHECK(pair.at("b") == "cpu/path");
    }
}

TEST_CASE("generate random writes a scene that moves and plays", "[app]") {
    const TemporaryFolder folder;
    const std::string file = folder.file("random.gltf");
    const ProcessResult written =
        run_diptych(folder, {"generate", "random", "--seed", "5", "--moving", "-o", file, "--json"});
    REQUIRE(written.exit_code == 0);
    const std::string arguments = nlohmann::json::parse(written.out).at("recommended_arguments");
    std::vector<std::string> command{"render", file};
    const std::vector<std::string> words = words_of(arguments);
    command.insert(command.end(), words.begin(), words.end());
    command.insert(command.end(), {"--spp", "2", "--backend", "cpu", "-o", folder.file("picture.#.exr")});
    const ProcessResult rendered = run_diptych(folder, command);
    INFO(rendered.err);
    REQUIRE(rendered.exit_code == 0);
    const Image first = read_image(folder.file("picture.0.exr")).color;
    const Image last = read_image(folder.file("picture.4.exr")).color;
    CHECK(first.data != last.data);
    CHECK_FALSE(std::filesystem::exists(folder.file("picture.5.exr")));
}

TEST_CASE("verify refuses what does not go with random scenes", "[app]") {
    const TemporaryFolder folder;
    const auto refused = [&](const std::vector<std::string>& arguments, const std::string& reason) {
        const ProcessResult result = run_diptych(folder, arguments);
        INFO(result.err);
        CHECK(result.exit_code == 2);
        CHECK(contains(result.err, reason));
    };
    refused({"verify", "--random", "1", "--spp", "8"}, "--spp: does not work with --random");
    refused({"verify", "scene.gltf", "--random", "1"}, "scene: does not work with --random");
    refused({"verify", "--random", "1", "--backends", "oracle"}, "--random compares cpu and vulkan");
    refused({"verify"}, "needs a scene");
    refused({"verify", "scene.gltf", "--no-shrink"}, "--random");
    refused({"verify", "scene.gltf", "--moving"}, "--random");
    refused({"generate", "cornell", "-o", folder.file("a.gltf"), "--moving"}, "--moving works only with random");
    refused({"generate", "random", "-o", folder.file("a.gltf"), "--count", "3"}, "--count works only with many-lights");
}
