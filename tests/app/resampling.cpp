// What the command line makes of ris and restir.
#include <nlohmann/json.hpp>

#include "catch.h"
#include "image/image_file.h"
#include "image/layered_image.h"
#include "process.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

ProcessResult run_on(const TemporaryFolder& folder, const std::string& command, const std::string& scene,
                     std::vector<std::string> more) {
    more.insert(more.begin(), {command, scene, "--size", "32x32"});
    return run_diptych(folder, more);
}

}  // namespace

TEST_CASE("A render with restir repeats from its metadata, and compare does not trust its standard errors", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string a = folder.file("a.exr");
    const std::string b = folder.file("b.exr");
    REQUIRE(run_on(folder, "render", scene, {"-o", a, "--spp", "4", "--integrator", "restir", "--spatial-passes", "2"})
                .exit_code == 0);
    REQUIRE(run_on(folder, "render", scene, {"-o", b, "--spp", "4", "--seed", "2"}).exit_code == 0);
    const std::string command = read_image(a).metadata.at("command");
    INFO(command);
    CHECK(command.find("--spatial-passes 2") != std::string::npos);
    const ProcessResult result = run_diptych(folder, {"compare", a, b});
    INFO(result.out);
    CHECK(result.out.find("correlated") != std::string::npos);
}

TEST_CASE("Resampling is refused where it would be ignored, or would read what is not there", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string out = folder.file("out.exr");
    check_refusal(run_on(folder, "render", scene, {"-o", out, "--candidates", "4"}), 2, {"--candidates", "restir"});
    check_refusal(run_on(folder, "render", scene, {"-o", out, "--integrator", "restir", "--atlas", "12"}), 2,
                  {"--atlas 12", "32x32"});
    check_refusal(run_on(folder, "bench", scene, {"--candidates", "4"}), 2, {"--candidates", "restir"});
    check_refusal(run_on(folder, "replay", scene, {"--pixel", "1,1", "--sample", "0", "--integrator", "ris"}), 2,
                  {"--integrator ris", "replay"});
    check_refusal(run_on(folder, "verify", scene, {"--paired", "--integrators", "restir"}), 2,
                  {"--integrators restir", "--paired"});
}

TEST_CASE("bench times every pass of restir", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const ProcessResult result = run_on(
        folder, "bench", scene, {"--integrators", "ris,restir", "--spatial-passes", "2", "--frames", "5", "--json"});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out).at("integrators");
    const auto names = [](const nlohmann::json& integrator) {
        std::vector<std::string> all;
        double milliseconds = 0;
        for (const auto& pass : integrator.at("passes")) {
            all.push_back(pass.at("pass"));
            CHECK(pass.at("milliseconds") > 0);
            milliseconds += pass.at("milliseconds").get<double>();
        }
        CHECK(milliseconds < 2 * integrator.at("milliseconds").get<double>());
        CHECK(integrator.at("share_of_bare").is_null());
        return all;
    };
    CHECK(names(json.at(0)) == std::vector<std::string>{"first hits", "candidates", "shadows", "shade"});
    CHECK(names(json.at(1)) == std::vector<std::string>{"first hits", "candidates", "temporal", "spatial 1",
                                                        "spatial 2", "shadows", "shade"});
}
