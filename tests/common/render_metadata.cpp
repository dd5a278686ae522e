#include "catch.h"

#include "error.h"
#include "image_fixtures.h"
#include "render/metadata.h"
#include "request_of_everything.h"
#include "settings/names.h"

using namespace diptych::core;
using diptych::core::image_tests::contains;
using diptych::core::tests::request_of_everything;

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

TEST_CASE("the settings that metadata tell are those they were made of", "[render]") {
    RenderRequest request = request_of_everything();
    for (const Integrator integrator : {Integrator::direct, Integrator::restir}) {
        request.settings.integrator = integrator;
        request.settings.resampling = {3, 0.1F, false, false, 2, 5, 7.25F, 1.0F / 3, ResamplingMis::balance,
                                       ResamplingVisibility::biased_initial};
        request.settings.normal_maps = NormalMaps::microfacet;
        request.settings.atlas_tile = 16;
        request.settings.moves = false;  // the scene's, not the picture's
        RenderSettings told = settings_in(render_metadata(request, {}));
        if (integrator == Integrator::direct) {  // which heeds neither
            told.resampling = request.settings.resampling;
            told.atlas_tile = request.settings.atlas_tile;
        }
        CHECK(told == request.settings);
    }
    RenderSettings of_old_pictures;
    of_old_pictures.light_sampler = LightSampler::power;
    CHECK(settings_in({}) == of_old_pictures);
    CHECK_THROWS_WITH(settings_in({{"seed", "1e9"}}), Catch::Contains("its metadata seed is '1e9'"));
    CHECK_THROWS_WITH(settings_in({{"mis", "max"}}), Catch::Contains("power, balance"));
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
    for (const LightSampler value : {LightSampler::uniform, LightSampler::power, LightSampler::spatial}) {
        CHECK(light_sampler_from_name(name_of(value)) == value);
    }
    try {
        sampler_from_name("halton");
        FAIL("accepted");
    } catch (const Error& error) {
        CHECK(contains(error.what(), "`sampler` halton"));
        CHECK(contains(error.what(), "independent, hammersley, sobol"));
    }
}
