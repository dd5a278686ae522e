#include "catch.h"

#include <nlohmann/json.hpp>

#include "process.h"

using namespace diptych::core;
using namespace diptych::core::tests;

TEST_CASE("replay prints a path vertex by vertex, on the CPU alone", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::vector<std::string> arguments = {"replay",     scene, "--pixel", "16,20", "--sample", "3",
                                                "--backends", "cpu", "--size",  "32",    "--seed",   "9"};
    const ProcessResult result = run_diptych(folder, arguments);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK(result.err.empty());
    for (const char* part :
         {"pixel 16,20 of 32x32, sample 3, seed 9, path", "cpu: ", "vertex 0", "vertex 1", "position", "barycentrics",
          "light", "shadow ray", "lobe", "bsdf pdf", "roulette", "throughput", "the whole path", "radiance"}) {
        INFO(part);
        CHECK(contains(result.out, part));
    }
    CHECK_FALSE(contains(result.out, "part at"));

    std::vector<std::string> with_json = arguments;
    with_json.emplace_back("--json");
    const auto json = nlohmann::json::parse(run_diptych(folder, with_json).out);
    CHECK(json.at("pixel") == nlohmann::json::array({16, 20}));
    CHECK(json.at("seed") == 9);
    CHECK(json.at("parting").is_null());
    REQUIRE(json.at("paths").size() == 1);
    const auto& path = json.at("paths")[0];
    CHECK(path.at("backend") == "cpu");
    REQUIRE(path.at("vertices").size() >= 2);
    double red = 0;
    for (const auto& vertex : path.at("vertices")) {
        red += vertex.at("emission")[0].get<double>();
        red += vertex.at("shadow") == "free" ? vertex.at("direct")[0].get<double>() : 0;
    }
    CHECK(path.at("radiance")[0].get<double>() == Approx(red).epsilon(1e-5));
}

TEST_CASE("replay sets both backends side by side", "[app]") {
    NEED_PROGRAM_WITH_VULKAN();
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const ProcessResult result =
        run_diptych(folder, {"replay", scene, "--pixel", "16,20", "--size", "32", "--max-depth", "3"});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK(contains(result.out, "cpu: "));
    CHECK(contains(result.out, "vulkan: "));
    CHECK(contains(result.out, "No vertex differs by more than 0.001."));
    const ProcessResult strict =
        run_diptych(folder, {"replay", scene, "--pixel", "16,20", "--size", "32", "--tolerance", "0", "--json"});
    const auto json = nlohmann::json::parse(strict.out);
    CHECK(json.at("paths").size() == 2);
    CHECK(json.at("tolerance") == 0);
}

TEST_CASE("replay refuses what it cannot replay", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    check_refusal(run_diptych(folder, {"replay", scene, "--pixel", "32,0", "--size", "32", "--backends", "cpu"}), 2,
                  {"--pixel 32,0", "32x32"});
    check_refusal(run_diptych(folder, {"replay", scene}), 2, {"--pixel"});
    check_refusal(run_diptych(folder, {"replay", scene, "--pixel", "1", "--backends", "cpu"}), 2, {"--pixel"});
    check_refusal(run_diptych(folder, {"replay", scene, "--pixel", "-1,2", "--backends", "cpu"}), 2, {"--pixel"});
    check_refusal(run_diptych(folder, {"replay", scene, "--pixel", "1,1", "--backends", "gpu"}), 2, {"gpu", "vulkan"});
    check_refusal(run_diptych(folder, {"replay", scene, "--pixel", "1,1", "--backends", "cpu,cpu"}), 2, {"twice"});
    check_refusal(run_diptych(folder, {"replay", scene, "--pixel", "1,1", "--backends", "cpu", "--device", "0"}), 2,
                  {"--device", "vulkan"});
    check_refusal(run_diptych(folder, {"replay", folder.file("no.gltf"), "--pixel", "1,1"}), 2, {"no.gltf"});
}

TEST_CASE("verify --paired compares panels path by path", "[app]") {
    NEED_PROGRAM_WITH_VULKAN();
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::vector<std::string> paired = {"verify", scene,    "--paired", "--size",
                                             "32",     "--spp",  "4",        "--integrators",
                                             "path",   "--json", "-o",       folder.path().string()};
    const ProcessResult result = run_diptych(folder, paired);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out);
    CHECK(json.at("verdict") == "PASS");
    CHECK(json.at("backends") == nlohmann::json::array({"cpu", "vulkan"}));
    const auto& pair = json.at("pairs").at(0);
    CHECK(pair.at("paths") == 32 * 32 * 4);
    CHECK(pair.at("alike_percent").get<double>() > 99.9);
    CHECK(pair.at("vertices").at(0).at("paths") == 32 * 32 * 4);
    CHECK(std::filesystem::exists(pair.at("output").get<std::string>()));
    check_refusal(run_diptych(folder, {"verify", scene, "--paired", "--runs", "8"}), 2, {"--paired", "--runs"});
    check_refusal(run_diptych(folder, {"verify", scene, "--paired", "--against", "oracle"}), 2, {"oracle"});
}
