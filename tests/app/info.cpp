#include "catch.h"

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>

#include "process.h"
#include "skipping.h"

using namespace diptych::core::tests;

namespace {

nlohmann::json info(const TemporaryFolder& folder, const std::string& scene, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"info", scene, "--json"});
    const ProcessResult result = run_diptych(folder, more);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return nlohmann::json::parse(result.out);
}

bool has(const nlohmann::json& list, const char* word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

}  // namespace

TEST_CASE("info counts a scene and its bytes", "[app]") {
    const TemporaryFolder folder;
    const auto json = info(folder, write_bare_triangle(folder), {"--size", "10x20", "--no-layers"});
    CHECK(json.at("triangles") == 1);
    CHECK(json.at("placed_triangles") == 1);
    CHECK(json.at("instances") == 1);
    CHECK(json.at("materials") == 1);
    CHECK(json.at("textures") == 0);
    CHECK(json.at("lights") == 1);  // the neutral sky
    CHECK(json.at("bounds") == nlohmann::json::parse("[[0, 0, 0], [1, 1, 0]]"));
    CHECK(json.at("warnings").size() == 2);
    CHECK(json.at("buffers").at("triangles") == 12);
    CHECK(json.at("buffers").at("positions") >= 3 * 12);  // and perhaps padding
    CHECK(json.at("buffers").at("film") == 10 * 20 * 92);
    CHECK_FALSE(json.at("buffers").contains("film_moments"));
    std::uint64_t sum = 0;
    for (const auto& bytes : json.at("buffers")) {
        sum += bytes.get<std::uint64_t>();
    }
    const auto structures = json.at("acceleration_structures").get<std::uint64_t>();
    CHECK(structures > 0);
    CHECK(json.at("bytes") == sum + structures);
}

TEST_CASE("info's bytes are those that render holds, on the backend asked for", "[app]") {
    const std::string backend = GENERATE("cpu", "vulkan");
    if (backend == "vulkan" && !program_has_vulkan()) {
        report_left_out("Vulkan: no device with ray tracing, or built without");
        return;
    }
    INFO(backend);
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::vector<std::string> common = {"--backend", backend, "--size", "10x20", "--json"};
    std::vector<std::string> render = {"render", scene, "--spp", "1", "-o", folder.file("out.exr")};
    render.insert(render.end(), common.begin(), common.end());
    const ProcessResult rendered = run_diptych(folder, render);
    INFO(rendered.err);
    REQUIRE(rendered.exit_code == 0);
    const auto json = info(folder, scene, {"--backend", backend, "--size", "10x20"});
    CHECK(json.at("backend") == backend);
    const auto bytes = nlohmann::json::parse(rendered.out).at("bytes").get<double>();
    // Embree's structures differ by a little from build to build, with its threads.
    CHECK(json.at("bytes").get<double>() == Approx(bytes).epsilon(backend == "cpu" ? 0.05 : 0));
}

TEST_CASE("what is needed and what is left out follow the options", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const auto plain = info(folder, scene);
    CHECK(has(plain.at("left_out"), "ggx"));  // nothing there reflects but diffusely
    CHECK(has(plain.at("left_out"), "blinn-phong"));
    CHECK(has(plain.at("left_out"), "textures"));
    CHECK(has(plain.at("left_out"), "environment-map"));
    const std::string glossy = generate_scene(folder, "veach-mis");
    CHECK(has(info(folder, glossy).at("features"), "ggx"));
    const auto phong = info(folder, glossy, {"--brdf", "blinn-phong", "--env", "1,1,1", "--integrator", "brdf"});
    CHECK(has(phong.at("features"), "blinn-phong"));
    CHECK(has(phong.at("left_out"), "ggx"));
    CHECK(has(phong.at("features"), "constant-environment"));
    CHECK(has(phong.at("left_out"), "light-sampling"));
    const auto generic = info(folder, scene, {"--generic"});
    CHECK(generic.at("left_out").empty());
    CHECK(generic.at("features").size() == plain.at("features").size() + plain.at("left_out").size());
}

TEST_CASE("info lists the devices", "[app]") {
    const TemporaryFolder folder;
    const ProcessResult result = run_diptych(folder, {"info", "--devices", "--json"});
    REQUIRE(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out);
    CHECK(json.at("cpu").at("threads").get<int>() >= 1);
    CHECK(json.at("cpu").at("usable") == true);
    for (const auto& device : json.at("vulkan")) {
        CHECK(device.at("usable").get<bool>() == device.at("lacks").empty());
        CHECK_FALSE(device.at("name").get<std::string>().empty());
    }
    const ProcessResult text = run_diptych(folder, {"info", "--devices"});
    CHECK(text.out.find("Embree") != std::string::npos);
}

TEST_CASE("bench measures every integrator in one run", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const ProcessResult result =
        run_diptych(folder, {"bench", scene, "--size", "16", "--frames", "5", "--integrators", "brdf,path", "--json"});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out);
    CHECK(json.at("width") == 16);
    REQUIRE(json.at("integrators").size() == 2);
    CHECK(json.at("integrators")[0].at("cost_relative_to_brdf") == 1);
    for (const auto& entry : json.at("integrators")) {
        for (const char* field : {"milliseconds", "samples_per_second", "rays_per_second", "bare_rays_per_second",
                                  "share_of_bare", "cost_relative_to_brdf"}) {
            INFO(field);
            CHECK(entry.at(field).get<double>() > 0);
        }
    }
    check_refusal(run_diptych(folder, {"bench", scene, "--integrators", "brdf,bdpt"}), 2, {"bdpt"});
}

TEST_CASE("bench ends at Ctrl-C, and says what it has", "[app]") {
    const TemporaryFolder folder;
    Process process(folder, {"bench", generate_scene(folder, "cornell"), "--size", "16", "--frames", "10000", "--spp",
                             "64", "--json"});
    REQUIRE(process.wait_for_error_text("steps", 60));
    process.send(SIGINT);
    const ProcessResult result = process.finish();
    CHECK(result.exit_code == 130);
    // Nothing, unless a whole frame of every integrator had come.
    CHECK((result.out.empty() || nlohmann::json::parse(result.out).at("interrupted") == true));
    CHECK(contains(result.err, "cornell.glb: interrupted after "));
}
