#include "catch.h"

#include <nlohmann/json.hpp>

#include "image/image_file.h"
#include "process.h"
#include "svg.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// A quick verify on the CPU against itself.
ProcessResult verify(const TemporaryFolder& folder, const std::string& scene, std::vector<std::string> more) {
    std::vector<std::string> arguments = {"verify", scene, "--backends", "cpu"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_diptych(folder, arguments);
}

const std::vector<std::string> small = {"--size", "32", "--runs", "8", "--spp", "8", "--max-depth", "3"};

}  // namespace

TEST_CASE("verify tells pairs, intervals and verdicts, and draws them", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string figures = folder.file("figures");
    const ProcessResult result = verify(folder, scene, with(small, {"--json", "-o", figures}));
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out);
    CHECK(json.at("verdict") == "INCONCLUSIVE");  // 8 samples show no 0.1 %
    REQUIRE(json.at("pairs").size() == 3);
    const char* integrators[] = {"brdf", "direct", "path"};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& pair = json.at("pairs")[i];
        CHECK(pair.at("a") == std::string("cpu/") + integrators[i]);
        CHECK(pair.at("b") == std::string("cpu/") + integrators[i]);
        CHECK(pair.at("verdict") == "INCONCLUSIVE");
        CHECK(pair.at("ci95_percent")[0].get<double>() < pair.at("bias_percent").get<double>());
        CHECK(pair.at("ci95_percent")[1].get<double>() > pair.at("bias_percent").get<double>());
        CHECK(pair.at("bias_percent").get<double>() != 0);  // the two sides have seeds of their own
        CHECK(pair.at("min_detectable_percent").get<double>() > pair.at("half_width_percent").get<double>());
        CHECK(pair.at("fisher_p").get<double>() > 1e-3);
        CHECK(pair.at("min_p").get<double>() > 1e-4);
        CHECK(pair.at("tiles") == 4);
        CHECK(pair.at("seed_a") != pair.at("seed_b"));
    }
    REQUIRE(json.at("figures").size() == 6);
    check_svg_files(folder, json.at("figures"));
    CHECK(contains(json.at("figures")[0], "cpu-brdf-vs-cpu-brdf-p.svg"));
    CHECK(contains(file_text(json.at("figures")[0]), "href=\"data:image/png;base64,iVBOR"));
    CHECK(contains(json.at("figures")[5], "cpu-path-vs-cpu-path-histogram.svg"));
    for (const std::string path : json.at("figures")) {
        CHECK(contains(file_text(path), "</svg>"));
        CHECK(contains(file_text(path), ">cpu/"));
    }
    // The same again is the same to the last digit, but for the time.
    auto again = nlohmann::json::parse(verify(folder, scene, with(small, {"--json", "-o", figures})).out);
    again["seconds"] = json.at("seconds");
    CHECK(again == json);
}

TEST_CASE("verify passes with power enough, and says where it lacks some", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "furnace");
    const ProcessResult passed =
        verify(folder, scene,
               with(small, {"--integrators", "brdf,path", "--max-half-width", "5", "--max-tile-half-width", "20"}));
    INFO(passed.out << passed.err);
    CHECK(passed.exit_code == 0);
    CHECK(passed.out.substr(passed.out.size() - 5) == "PASS\n");
    const std::string box = generate_scene(folder, "cornell");
    const ProcessResult weak = verify(folder, box, with(small, {"--integrators", "brdf", "--require-pass"}));
    CHECK(weak.exit_code == 1);
    CHECK(contains(weak.out, "try --spp"));
    // The command that it prints tells: here, that there is power enough, or a difference.
    const std::string head = "To tell: diptych verify ";
    const std::size_t begin = weak.out.find(head);
    REQUIRE(begin != std::string::npos);
    const std::string told = weak.out.substr(begin + head.size(), weak.out.find('\n', begin) - begin - head.size());
    CHECK(contains(told, box));
    CHECK(contains(told, "--integrators brdf"));
    CHECK(contains(told, "--require-pass"));
    CHECK(contains(told, "--spp "));
    CHECK_FALSE(contains(told, "--spp 8 "));
    CHECK_FALSE(contains(told, "--time"));
    CHECK(weak.out.substr(weak.out.size() - 13) == "INCONCLUSIVE\n");
}

TEST_CASE("verify fails on samples that are no radiance", "[app]") {
    const TemporaryFolder folder;
    // A sky and a sun near the largest float: what a surface reflects of both overflows.
    const ProcessResult failed =
        verify(folder, write_bare_triangle(folder),
               {"--size", "16", "--runs", "3", "--spp", "4", "--integrators", "direct", "--env", "3e38,3e38,3e38",
                "--sun", "180,60,3.3e38"});
    INFO(failed.out << failed.err);
    CHECK(failed.exit_code == 1);
    CHECK(contains(failed.out, "samples were not finite"));
    CHECK(failed.out.substr(failed.out.size() - 5) == "FAIL\n");
}

TEST_CASE("verify compares integrators with one reference", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const ProcessResult result =
        verify(folder, scene, with(small, {"--integrators", "brdf,direct", "--against", "cpu/path", "--json"}));
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out);
    REQUIRE(json.at("pairs").size() == 2);
    CHECK(json.at("pairs")[0].at("a") == "cpu/brdf");
    CHECK(json.at("pairs")[1].at("a") == "cpu/direct");
    CHECK(json.at("pairs")[1].at("b") == "cpu/path");
    CHECK(json.at("pairs")[0].at("seed_b") == json.at("pairs")[1].at("seed_b"));  // rendered once
    const ProcessResult judged =
        verify(folder, scene, with(small, {"--integrators", "brdf,path", "--against", "oracle", "--json"}));
    INFO(judged.err);
    REQUIRE(judged.exit_code == 0);
    const auto by_oracle = nlohmann::json::parse(judged.out);
    CHECK(by_oracle.at("pairs")[1].at("b") == "oracle/mis");
    CHECK(by_oracle.at("pairs")[0].at("seed_b") == by_oracle.at("pairs")[1].at("seed_b"));
}

TEST_CASE("verify keeps to its time, and fresh seeds can be repeated", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::vector<std::string> timed = {"--size",        "16",   "--runs", "4", "--tile", "8",
                                            "--integrators", "path", "--json"};
    const ProcessResult result = verify(folder, scene, with(timed, {"--time", "1"}));
    INFO(result.err);
    CHECK(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out);
    CHECK(json.at("pairs")[0].at("spp").get<int>() > 4);
    CHECK(json.at("seconds").get<double>() < 20);
    const ProcessResult fresh = verify(folder, scene, with(timed, {"--spp", "4", "--fresh-seeds"}));
    const auto fresh_json = nlohmann::json::parse(fresh.out);
    const std::string seed = std::to_string(fresh_json.at("seed").get<std::uint32_t>());
    const auto repeated =
        nlohmann::json::parse(verify(folder, scene, with(timed, {"--spp", "4", "--fresh-seeds", "--seed", seed})).out);
    CHECK(repeated.at("pairs") == fresh_json.at("pairs"));
    CHECK(fresh_json.at("seed") !=
          nlohmann::json::parse(verify(folder, scene, with(timed, {"--spp", "4", "--fresh-seeds"})).out).at("seed"));
}

TEST_CASE("verify refuses what it cannot compare", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const auto refused = [&](const std::vector<std::string>& more, const std::vector<std::string>& parts) {
        INFO(more[0]);
        check_refusal(verify(folder, scene, more), 2, parts);
    };
    refused({"--integrators", "bdpt"}, {"bdpt", "brdf, direct, path"});
    refused({"--integrators", "path,path"}, {"--integrators", "path twice"});
    refused({"--against", "oracle/bdpt"}, {"bdpt", "mis, bsdf, hemisphere, area"});
    refused({"--against", "metal"}, {"--against metal", "cpu, vulkan, oracle"});
    refused({"--against", "cpu/bdpt"}, {"bdpt"});
    check_refusal(run_diptych(folder, {"verify", scene, "--backends", "cpu,metal"}), 2,
                  {"--backends metal", "cpu, vulkan"});
    refused({"--device", "0"}, {"--device", "vulkan"});
    refused({"--validation"}, {"--validation", "vulkan"});
    check_refusal(
        run_diptych(folder, {"verify", scene, "--backends", "vulkan", "--against", "vulkan", "--threads", "2"}), 2,
        {"--threads", "CPU"});
    refused({"--runs", "1"}, {"--runs"});
    refused({"--tile", "0"}, {"--tile"});
    refused({"--alpha", "2"}, {"--alpha"});
    refused({"--max-half-width", "0"}, {"--max-half-width"});
    refused({"--time", "3", "--spp", "2"}, {"--time", "--spp"});
    refused({"--time", "3", "--sampler", "hammersley"}, {"--sampler hammersley", "--spp"});
    refused({"-o", folder.file("no/such")}, {"no/such"});
    write_text(folder.file("file"), "");
    refused({"-o", folder.file("file")}, {"file", "folder"});
    check_refusal(run_diptych(folder, {"verify", folder.file("missing.gltf"), "--backends", "cpu"}), 2,
                  {"missing.gltf"});
}
