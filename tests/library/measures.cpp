// verify, compare and replay by the public interface.
#include <cmath>

#include "library/library_fixture.h"

using namespace library_tests;

namespace {

dp::VerifyOptions options(dp::Side a, dp::Side b) {
    dp::VerifyOptions options;
    options.a = a;
    options.b = b;
    options.settings = small_settings();
    options.runs = 16;
    options.spp = 64;
    options.tile = 8;
    options.max_half_width = 3;
    options.max_tile_half_width = 20;
    return options;
}

}  // namespace

TEST_CASE("verify passes integrators of one expectation and fails those of two") {
    const dp::Scene scene = small_scene();
    std::uint32_t begun = 0;
    dp::VerifyOptions same =
        options({dp::Backend::cpu, dp::Integrator::restir}, {dp::Backend::cpu, dp::Integrator::direct});
    same.settings.max_depth = 1;
    same.progress = [&](std::uint32_t run, std::uint32_t runs) {
        CHECK(run == begun++);
        CHECK(runs == 32);
    };
    const dp::Verdict pass = dp::verify(scene, same);
    INFO(pass.reason << ", " << pass.bias_percent << " +- " << pass.ci95);
    CHECK(pass.verdict == dp::VerdictKind::pass);
    CHECK(begun == 32);
    CHECK(pass.tiles_x == 3);
    CHECK(pass.tiles_y == 2);
    CHECK(pass.p_values.size() == 6);

    same.progress = {};
    same.settings.resampling.visibility = dp::ResamplingVisibility::biased_initial;
    same.settings.size = {48, 32};
    const dp::Verdict fail = dp::verify(dp::load(source_dir + "/scenes/cornell.gltf"), same);
    INFO(fail.reason << ", " << fail.bias_percent << " +- " << fail.ci95);
    CHECK(fail.verdict == dp::VerdictKind::fail);
    CHECK(fail.p <= 1e-3);
    CHECK(std::abs(fail.bias_percent) > fail.ci95);
}

TEST_CASE("verify stops, and refuses what it cannot judge") {
    const dp::Scene scene = small_scene();
    dp::VerifyOptions stopping = options({}, {});
    std::stop_source stop;
    stopping.stop = stop.get_token();
    stopping.progress = [&](std::uint32_t run, std::uint32_t) {
        if (run == 3) {
            stop.request_stop();
        }
    };
    CHECK_THROWS_AS(dp::verify(scene, stopping), dp::Interrupted);
    dp::VerifyOptions few = options({}, {});
    few.runs = 2;
    CHECK_THROWS_WITH(dp::verify(scene, few), Catch::Contains("runs is 2"));
}

TEST_CASE("compare says how far two films differ") {
    const dp::Scene scene = small_scene();
    dp::Settings settings = small_settings();
    const dp::Film a = rendered(scene, dp::Backend::cpu, settings, 64);
    settings.seed = 5;
    const dp::Film b = rendered(scene, dp::Backend::cpu, settings, 64);
    const dp::Comparison same = dp::compare(a, a);
    CHECK(same.mse == 0);
    CHECK(same.fraction_equal == 1);
    const dp::Comparison noise = dp::compare(a, b);
    CHECK(noise.relmse > 0);
    CHECK(std::abs(noise.z[1]) < 5);
    settings.max_depth = 1;
    const dp::Comparison bias = dp::compare(rendered(scene, dp::Backend::cpu, settings, 64), b);
    CHECK(bias.mean_ratio[1] < 0.98);
    settings.size = {8, 8};
    CHECK_THROWS_AS(dp::compare(a, rendered(scene, dp::Backend::cpu, settings, 1)), dp::Error);
}

TEST_CASE("replay finds where two paths part, and leaves the films alone") {
    dp::Scene scene = small_scene();
    dp::Scene darker = small_scene();
    darker.material("white").base_color = {0.4F, 0.4F, 0.4F, 1};
    dp::Session a(scene, {}, small_settings());
    dp::Session b(darker, {}, small_settings());
    a.render(1);
    const dp::Film before = a.film();
    dp::ReplayOptions at;
    at.pixel = {12, 12};
    const dp::ReplayResult parted = dp::replay(a, b, at);
    REQUIRE(parted.parts_at.has_value());
    CHECK_THAT(parted.text, Catch::Contains("part at vertex"));
    CHECK(parted.vertices[0].at(0).position[1] == Approx(0).margin(1e-4));  // the floor
    CHECK(same_bits(a.film(), before));

    dp::Session c(scene, {}, small_settings());
    CHECK_FALSE(dp::replay(a, c, at).parts_at.has_value());
    at.pixel = {24, 0};
    CHECK_THROWS_WITH(dp::replay(a, c, at), "replay: pixel 24,0 lies outside 24x16");
    dp::BackendChoice oracle;
    oracle.backend = dp::Backend::oracle;
    dp::Session o(scene, oracle, small_settings());
    at.pixel = {0, 0};
    CHECK_THROWS_WITH(dp::replay(a, o, at), "replay: backend oracle keeps no record of its paths");
}
