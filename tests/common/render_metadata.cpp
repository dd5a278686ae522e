#include "catch.h"

#include "error.h"
#include "image_fixtures.h"
#include "render/metadata.h"
#include "settings/names.h"

using namespace diptych::core;
using diptych::core::image_tests::contains;

namespace {

RenderRequest request_of_everything() {
    RenderRequest request;
    request.scene = "a scene's.gltf";
    request.ignored_extensions = {"EXT_one", "EXT_two"};
    request.allow_external = true;
    request.clip = "slow walk";
    request.output = "out.exr";
    request.backend = "vulkan";
    request.device = "1";
    request.camera = "Front view";
    request.environment = "0.1,0.2,0.3";
    request.tonemap = "aces";
    request.environment_scale = 0.1;
    request.environment_rotation = -30;
    request.lens.radius = 0.01;
    request.lens.focus_distance = 2.5;
    request.viewpoint.eye = glm::dvec3(1, -2.5, 3e-7);
    request.viewpoint.look_at = glm::dvec3(0, 0.1, 0);
    request.viewpoint.up = glm::dvec3(0, 0, 1);
    request.viewpoint.fov = 33.5;
    request.viewpoint.view_height = 4;
    request.sun = Sun{-20, 35.5, 3};
    request.exposure = -1.5;
    request.settings.width = 640;
    request.settings.height = 480;
    request.settings.integrator = Integrator::direct;
    request.settings.brdf = BrdfModel::blinn_phong;
    request.settings.sampler = SamplerKind::hammersley;
    request.settings.sample_count = 256;
    request.settings.mis = MisHeuristic::balance;
    request.settings.seed = 4294967295U;
    request.settings.generic = true;
    return request;
}

}  // namespace

TEST_CASE("the sky that a scene was given is on record", "[render]") {
    RenderRequest request;
    CHECK(render_metadata(request, {}).at("env").empty());
    request.adds_neutral_sky = true;
    CHECK(render_metadata(request, {}).at("env") == "neutral");
}

TEST_CASE("metadata tell how the render went", "[render]") {
    RenderOutcome outcome;
    outcome.maker.program = "diptych 1.2.3";
    outcome.maker.command = [](const RenderRequest& request, std::uint32_t spp) {
        return "render " + request.output + " " + std::to_string(spp);
    };
    outcome.device = "a device";
    outcome.spp = 77;
    outcome.interrupted = true;
    outcome.nonfinite = 3;
    const auto metadata = render_metadata(request_of_everything(), outcome);
    CHECK(render_metadata(request_of_everything(), {}).count("command") == 0);  // whoever makes it knows no command
    CHECK(metadata.at("program") == "diptych 1.2.3");
    CHECK(metadata.at("device") == "a device");
    CHECK(metadata.at("spp") == "77");
    CHECK(metadata.at("seed") == "4294967295");
    CHECK(metadata.at("ignored_extensions") == "EXT_one,EXT_two");
    CHECK(metadata.at("interrupted") == "yes");
    CHECK(metadata.at("uneven") == "no");
    CHECK(metadata.at("nonfinite") == "3");
    CHECK(metadata.at("eye") == "1,-2.5,3e-07");
    CHECK(metadata.at("sun") == "-20,35.5,3");
    CHECK(metadata.at("command") == "render out.exr 77");
}

TEST_CASE("names of settings lead back to them, and an unknown one lists the others", "[render]") {
    for (const Integrator value : {Integrator::brdf, Integrator::direct, Integrator::path}) {
        CHECK(integrator_from_name(name_of(value)) == value);
    }
    for (const BrdfModel value : {BrdfModel::ggx, BrdfModel::blinn_phong}) {
        CHECK(brdf_from_name(name_of(value)) == value);
    }
    for (const SamplerKind value : {SamplerKind::independent, SamplerKind::hammersley, SamplerKind::sobol}) {
        CHECK(sampler_from_name(name_of(value)) == value);
    }
    for (const MisHeuristic value : {MisHeuristic::power, MisHeuristic::balance}) {
        CHECK(mis_from_name(name_of(value)) == value);
    }
    try {
        sampler_from_name("halton");
        FAIL("accepted");
    } catch (const Error& error) {
        CHECK(contains(error.what(), "`sampler` halton"));
        CHECK(contains(error.what(), "independent, hammersley, sobol"));
    }
}
