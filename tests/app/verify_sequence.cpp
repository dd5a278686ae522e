// `verify --frame`: moments of a scene that moves, and chains of restir up to them.
#include <cmath>
#include <nlohmann/json.hpp>

#include "catch.h"
#include "image/image_file.h"
#include "image/layered_image.h"
#include "process.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

// The lamp switches on at 1 s (scenes/README.md), so frame 4 is the first that has it.
const std::vector<std::string> walk = {"--size", "16", "--max-depth", "1", "--fps", "8"};

std::vector<std::string> backends(const TemporaryFolder& folder) {
    const ProcessResult devices = run_diptych(folder, {"info", "--devices"});
    return devices.exit_code == 0 ? std::vector<std::string>{"cpu", "vulkan"} : std::vector<std::string>{"cpu"};
}

nlohmann::json verify_walk(const TemporaryFolder& folder, const std::string& scene, const std::vector<std::string>& more) {
    const ProcessResult result =
        run_diptych(folder, with(with({"verify", scene, "--json", "--start", "0.5"}, walk), more));
    INFO(result.err);
    REQUIRE_FALSE(result.out.empty());
    return nlohmann::json::parse(result.out);
}

void render_walk(const TemporaryFolder& folder, const std::string& scene, const std::string& output,
                 const std::vector<std::string>& more) {
    const ProcessResult result =
        run_diptych(folder, with(with({"render", scene, "-o", folder.file(output), "--overwrite"}, walk), more));
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
}

std::array<double, 3> mean_of(const TemporaryFolder& folder, const std::string& file) {
    const Image image = read_image(folder.file(file)).color;
    std::array<double, 3> mean{};
    for (std::size_t i = 0; i < image.data.size(); ++i) {
        mean[i % 3] += 3.0 * static_cast<double>(image.data[i]) / static_cast<double>(image.data.size());
    }
    return mean;
}

/// Mean of the picture that `render` makes with these options.
std::array<double, 3> picture_mean(const TemporaryFolder& folder, const std::string& scene, const std::string& file,
                                   const std::vector<std::string>& more) {
    render_walk(folder, scene, "walk.exr", more);
    return mean_of(folder, file);
}

void check_mean(const nlohmann::json& mean, const std::vector<std::array<double, 3>>& pictures) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
        double expected = 0;
        for (const auto& picture : pictures) {
            expected += picture[channel] / static_cast<double>(pictures.size());
        }
        INFO("channel " << channel);
        CHECK(expected > 0);
        CHECK(std::abs(mean[channel].get<double>() - expected) < 1e-6 * expected);
    }
}

}  // namespace

TEST_CASE("verify judges the frames that render paints", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "moving-light");
    for (const std::string& backend : backends(folder)) {
        INFO(backend);
        const auto json = verify_walk(folder, scene,
                                 {"--backends", backend, "--integrators", "restir", "--against", backend + "/path",
                                  "--runs", "2", "--spp", "2", "--frame", "5,3", "--seed", "11"});
        REQUIRE(json.at("pairs").size() == 2);
        CHECK(json.at("pairs")[0].at("frame") == 3);
        CHECK(json.at("pairs")[1].at("frame") == 5);
        CHECK(json.at("pairs")[1].at("time") == 1.125);
        // Both frames are of the same chains.
        const auto chain_seed = [&](const nlohmann::json& pair, std::uint32_t run, std::uint32_t chain) {
            return pair.at("seed_a").get<std::uint32_t>() + run + chain * pair.at("chain_seed_step").get<std::uint32_t>();
        };
        for (std::uint32_t run = 0; run < 2; ++run) {
            for (std::uint32_t chain = 0; chain < 2; ++chain) {
                const std::string seed = std::to_string(chain_seed(json.at("pairs")[0], run, chain));
                render_walk(folder, scene, "chain-" + seed + ".exr",
                            {"--start", "0.5", "--backend", backend, "--integrator", "restir", "--frames", "6", "--spp",
                             "1", "--seed", seed});
            }
        }
        for (const auto& pair : json.at("pairs")) {
            const int frame = pair.at("frame");
            INFO("frame " << frame);
            std::vector<std::array<double, 3>> chains;
            std::vector<std::array<double, 3>> moments;
            for (std::uint32_t run = 0; run < 2; ++run) {
                for (std::uint32_t chain = 0; chain < 2; ++chain) {
                    chains.push_back(mean_of(folder, "chain-" + std::to_string(chain_seed(pair, run, chain)) + ".000" +
                                                         std::to_string(frame) + ".exr"));
                }
                const std::uint32_t seed = pair.at("seed_b").get<std::uint32_t>() + run;
                moments.push_back(picture_mean(folder, scene, "walk.exr",
                                               {"--backend", backend, "--start", std::to_string(0.5 + frame / 8.0),
                                                "--spp", "2", "--seed", std::to_string(seed)}));
            }
            check_mean(pair.at("mean_a"), chains);
            check_mean(pair.at("mean_b"), moments);
        }
    }
}

TEST_CASE("A chain in verify may have several samples a frame", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "moving-light");
    const auto json = verify_walk(folder, scene,
                             {"--backends", "cpu", "--integrators", "restir", "--against", "cpu/path", "--runs", "2",
                              "--spp", "3", "--frame-spp", "3", "--frame", "4"});
    std::vector<std::array<double, 3>> chains;
    const std::uint32_t first = json.at("pairs")[0].at("seed_a");
    for (const std::uint32_t seed : {first, first + 1}) {
        chains.push_back(picture_mean(folder, scene, "walk.0004.exr",
                                      {"--start", "0.5", "--integrator", "restir", "--frames", "5", "--spp", "3",
                                       "--seed", std::to_string(seed)}));
    }
    check_mean(json.at("pairs")[0].at("mean_a"), chains);
}

TEST_CASE("verify finds a bias that only a light switched on brings about", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "moving-light");
    const std::vector<std::string> chains = {
        "--backends", "cpu", "--integrators", "restir", "--against", "cpu/path", "--runs", "16",
        "--spp",      "16",  "--against-spp", "64",     "--frame",   "0,5",      "-o",     folder.file("figures")};
    const auto biased = verify_walk(folder, scene, with(chains, {"--reuse-mis", "biased-1-over-m"}));
    CHECK(biased.at("verdict") == "FAIL");
    CHECK(biased.at("pairs")[1].at("verdict") == "FAIL");
    CHECK(biased.at("pairs")[1].at("ci95_percent")[1].get<double>() < 0);
    CHECK(std::string(biased.at("figures")[2]).find("cpu-restir-vs-cpu-path-frame-5-p.svg") != std::string::npos);
    const auto unbiased = verify_walk(folder, scene, chains);
    CHECK(unbiased.at("verdict") == "INCONCLUSIVE");  // too few samples for 0.1 %
    for (const auto& pair : unbiased.at("pairs")) {
        CHECK(pair.at("min_p").get<double>() > 1e-4);
    }
}

TEST_CASE("verify of a sequence keeps to its time, and a camera may turn", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const ProcessResult result = run_diptych(
        folder, {"verify", scene, "--backends", "cpu", "--integrators", "ris,restir", "--against", "cpu/path", "--size",
                 "8", "--max-depth", "1", "--runs", "4", "--orbit", "3", "--time", "1", "--json"});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out);
    REQUIRE(json.at("pairs").size() == 12);
    CHECK(json.at("pairs")[11].at("frame") == 16);
    CHECK(json.at("pairs")[11].at("spp").get<int>() >= 4);
    CHECK(json.at("pairs")[0].at("mean_b") != json.at("pairs")[5].at("mean_b"));  // the camera has turned
}

TEST_CASE("verify refuses sequences that it cannot judge", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "moving-light");
    const auto refuse = [&](const std::vector<std::string>& more, const std::vector<std::string>& parts) {
        check_refusal(run_diptych(folder, with({"verify", scene, "--backends", "cpu"}, more)), 2, parts);
    };
    refuse({"--frame", "1,4,1"}, {"--frame", "1 twice"});
    refuse({"--frame", "-1"}, {"--frame"});
    refuse({"--fps", "8"}, {"--fps", "--frame"});
    refuse({"--frame-spp", "2"}, {"--frame-spp", "--frame"});
    refuse({"--frame", "1", "--frame-spp", "3"}, {"--spp 64", "--frame-spp 3"});
    refuse({"--frame", "1", "--paired"}, {"--paired"});
}
