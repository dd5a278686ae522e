// What a change asks for, and no more.
#include "view/invalidation.h"

#include <functional>

#include "catch.h"

using namespace diptych::core;
using namespace diptych::core::app;

namespace {

Change after(const std::function<void(RenderedState&)>& change, RenderedState before = {}) {
    RenderedState state = before;
    change(state);
    CHECK(invalidation(state, state) == Change::nothing);
    CHECK(invalidation(state, before) == invalidation(before, state));
    return invalidation(before, state);
}

}  // namespace

TEST_CASE("Files and the way of showing invalidate nothing", "[view]") {
    CHECK(after([](RenderedState& s) { s.request.output = "other.exr"; }) == Change::nothing);
    CHECK(after([](RenderedState& s) { s.request.exposure = 3; }) == Change::nothing);
    CHECK(after([](RenderedState& s) { s.request.tonemap = "aces"; }) == Change::nothing);
    CHECK(after([](RenderedState& s) { s.request.spp = 1; }) == Change::nothing);
}

TEST_CASE("A seed invalidates the picture", "[view]") {
    CHECK(after([](RenderedState& s) { s.request.settings.seed = 9; }) == Change::picture);
}

TEST_CASE("The camera invalidates the view", "[view]") {
    RenderedState before;
    before.camera.lens.radius = 0.1;
    CHECK(after([](RenderedState& s) { s.camera.camera_to_world[3].x += 1; }, before) == Change::view);
    CHECK(after([](RenderedState& s) { s.camera.vertical_fov = 1; }, before) == Change::view);
    CHECK(after([](RenderedState& s) { s.camera.orthographic_height = 7; }, before) == Change::view);
    CHECK(after([](RenderedState& s) { s.camera.lens.radius = 0.2; }, before) == Change::view);
    CHECK(after([](RenderedState& s) { s.camera.lens.focus_distance = 9; }, before) == Change::view);
}

TEST_CASE("What moves invalidates the moment", "[view]") {
    RenderedState before;
    before.request.sun = Sun{};
    CHECK(after([](RenderedState& s) { s.time = 1; }, before) == Change::moment);
    CHECK(after([](RenderedState& s) { s.request.sun->azimuth = 9; }, before) == Change::moment);
    CHECK(after([](RenderedState& s) { s.request.environment_rotation = 9; }, before) == Change::moment);
    CHECK(after([](RenderedState& s) { s.request.environment_scale = 9; }, before) == Change::moment);
    const auto all = [](RenderedState& s) {
        s.request.settings.seed = 9;
        s.camera.vertical_fov = 1;
        s.time = 1;
    };
    CHECK(after(all, before) == Change::moment);
}

TEST_CASE("What is packed or compiled otherwise invalidates the settings", "[view]") {
    using Setting = std::function<void(RenderSettings&)>;
    const Setting changes[] = {[](RenderSettings& s) { s.width = 9; },
                              [](RenderSettings& s) { s.height = 9; },
                              [](RenderSettings& s) { s.integrator = Integrator::restir; },
                              [](RenderSettings& s) { s.brdf = BrdfModel::blinn_phong; },
                              [](RenderSettings& s) { s.sampler = SamplerKind::independent; },
                              [](RenderSettings& s) { s.mis = MisHeuristic::balance; },
                              [](RenderSettings& s) { s.light_sampler = LightSampler::uniform; },
                              [](RenderSettings& s) { s.max_depth = 9; },
                              [](RenderSettings& s) { s.camera = 1; },
                              [](RenderSettings& s) { s.standard_error = true; },
                              [](RenderSettings& s) { s.first_hit_layers = true; },
                              [](RenderSettings& s) { s.generic = true; },
                              [](RenderSettings& s) { s.resampling.light_candidates = 9; },
                              [](RenderSettings& s) { s.resampling.near_share = 0.25F; },
                              [](RenderSettings& s) { s.resampling.bsdf_candidate = false; },
                              [](RenderSettings& s) { s.resampling.temporal = false; },
                              [](RenderSettings& s) { s.resampling.spatial_passes = 2; },
                              [](RenderSettings& s) { s.resampling.neighbors = 2; },
                              [](RenderSettings& s) { s.resampling.radius = 2; },
                              [](RenderSettings& s) { s.resampling.confidence_cap = 2; },
                              [](RenderSettings& s) { s.resampling.mis = ResamplingMis::balance; },
                              [](RenderSettings& s) { s.resampling.visibility = ResamplingVisibility::target; }};
    for (const Setting& change : changes) {
        CHECK(after([&](RenderedState& s) { change(s.request.settings); }) == Change::settings);
    }
    CHECK(after([](RenderedState& s) { s.camera.lens.radius = 0.1; }) == Change::settings);
    CHECK(after([](RenderedState& s) { s.camera.orthographic = true; }) == Change::settings);
    CHECK(after([](RenderedState& s) { s.request.sun = Sun{}; }) == Change::settings);
    CHECK(after([](RenderedState& s) { s.request.environment_scale = 0; }) == Change::settings);
}

TEST_CASE("Another scene invalidates everything", "[view]") {
    const auto all = [](RenderedState& s) {
        s.scene = 2;
        s.request.settings.seed = 9;
        s.time = 1;
        s.request.settings.max_depth = 1;
    };
    CHECK(after(all) == Change::scene);
}
