// bench and converge by the public interface.
#include <cmath>
#include <stop_token>

#include "library/library_fixture.h"

using namespace library_tests;

namespace {

dp::ConvergeOptions small_measurement() {
    dp::ConvergeOptions options;
    options.methods = {"cpu:path:independent", "cpu:direct"};
    options.settings = small_settings();
    options.runs = 8;
    options.spp_max = 16;
    return options;
}

}  // namespace

TEST_CASE("converge measures how the error of methods falls, against a film") {
    int calls = 0;
    dp::ConvergeOptions options = small_measurement();
    const dp::Scene scene = small_scene();
    options.progress = [&](const std::string& step, int done, int steps) {
        CHECK_FALSE(step.empty());
        CHECK(done == calls++);
        CHECK(steps >= calls);
    };
    options.reference_film = rendered(scene, dp::Backend::cpu, options.settings, 1024);
    const dp::ConvergeResult result = dp::converge(scene, options);
    CHECK(calls > 16);
    REQUIRE(result.methods.size() == 2);
    const dp::ConvergeMethod& path = result.methods[0];
    CHECK(path.method == "cpu:path:independent");
    CHECK(path.runs == 8);
    CHECK_FALSE(path.device.empty());
    REQUIRE(path.points.size() == 5);
    for (std::size_t i = 0; i < path.points.size(); ++i) {
        const dp::ConvergePoint& point = path.points[i];
        CHECK(point.spp == 1U << i);
        CHECK(point.relmse.low <= point.relmse.value);
        CHECK(point.relmse.value <= point.relmse.high);
        CHECK(point.device_seconds > 0);
        CHECK(point.nonfinite == 0);
    }
    INFO("slope " << path.slope_mse.value);
    CHECK(path.slope_mse.value == Approx(-1).margin(0.3));
    CHECK_FALSE(path.bias_significant);
    CHECK(path.points.back().mse_net < path.points.front().mse_net / 4);
    CHECK(result.reference == "film");
    CHECK(result.reference_spp == 1024);

    REQUIRE(result.table.method.size() == 10);
    for (const dp::ConvergeColumn& column : result.table.columns) {
        REQUIRE(column.values.size() == 10);
        if (column.name == "relmse") {
            CHECK(column.values[4] == path.points[4].relmse.value);
        }
    }
    CHECK(result.table.columns.front().name == "spp");
    CHECK_THAT(result.text, Catch::Contains("cpu:direct") && Catch::Contains("24x16, 8 runs per method"));
    CHECK_THAT(result.page, Catch::StartsWith("<!DOCTYPE html>") && Catch::Contains("data:image/png;base64,"));
    CHECK(result.page.find("{{") == std::string::npos);
}

TEST_CASE("converge renders its own reference, and finds the bias of a darker scene's film") {
    dp::Scene darker = small_scene();
    darker.material("lamp").emission = {19, 17, 14};
    dp::ConvergeOptions options = small_measurement();
    options.methods = {"cpu:path"};
    const dp::ConvergeResult own = dp::converge(small_scene(), options);
    CHECK(own.reference == "cpu:path with mis balance");
    CHECK(own.reference_spp == 256);
    CHECK(own.reference_relmse > 0);
    CHECK_FALSE(own.methods[0].bias_significant);

    const Folder folder;
    rendered(darker, dp::Backend::cpu, options.settings, 1024).save(folder.file("darker.exr"));
    options.reference = folder.file("darker.exr");
    const dp::ConvergeResult biased = dp::converge(small_scene(), options);
    CHECK(biased.reference == folder.file("darker.exr"));
    CHECK(biased.methods[0].bias_significant);
    CHECK(biased.methods[0].points.back().relative_bias.value > 0);
}

TEST_CASE("converge stops, and refuses what it cannot measure by name") {
    const dp::Scene scene = small_scene();
    dp::ConvergeOptions options = small_measurement();
    std::stop_source stop;
    options.stop = stop.get_token();
    options.progress = [&](const std::string&, int done, int) {
        if (done == 3) {
            stop.request_stop();
        }
    };
    CHECK_THROWS_AS(dp::converge(scene, options), dp::Interrupted);
    const auto refusal = [&](auto change) -> std::string {
        dp::ConvergeOptions wrong = small_measurement();
        change(wrong);
        try {
            dp::converge(scene, wrong);
        } catch (const dp::SettingError& error) {
            return error.what();
        }
        return "accepted";
    };
    using O = dp::ConvergeOptions;
    using Catch::Contains;
    CHECK_THAT(refusal([](O& o) { o.methods = {"gpu:path"}; }), Contains("`methods` gpu:path: expected BACKEND"));
    CHECK_THAT(refusal([](O& o) { o.methods = {"cpu:photon"}; }), Contains("cpu:photon") && Contains("restir"));
    CHECK_THAT(refusal([](O& o) { o.methods = {"oracle:magic"}; }), Contains("magic"));
    CHECK_THAT(refusal([](O& o) { o.methods = {"cpu:path", "cpu:path"}; }), Contains("named twice"));
    CHECK_THAT(refusal([](O& o) { o.runs = 1; }), Contains("runs is 1"));
    CHECK_THAT(refusal([](O& o) { o.seconds = std::nan(""); }), Contains("seconds is nan"));
    CHECK(message_of([&] {
              O wrong = small_measurement();
              wrong.reference_film = rendered(scene, dp::Backend::cpu, small_settings(), 1);
              wrong.settings.size = {8, 8};
              dp::converge(scene, wrong);
          }) == "`reference` film: has 24x16 pixels, but 8x8 are rendered; give `size`");
}

TEST_CASE("bench measures rates, and says what the rest of a frame costs") {
    const dp::Scene scene = small_scene();
    for (const dp::Backend backend : panels()) {
        INFO(dp::name_of(backend));
        int calls = 0;
        dp::BenchOptions options;
        options.integrators = {dp::Integrator::brdf};
        if (backend == dp::Backend::cpu) {  // whose pipelines take no time to build
            options.integrators.push_back(dp::Integrator::restir);
        }
        const bool both = options.integrators.size() == 2;
        options.frames = 5;
        options.backend.backend = backend;
        options.settings = small_settings();
        options.progress = [&](const std::string&, int done, int steps) {
            CHECK(done == calls++);
            CHECK(steps == (both ? 15 : 8));  // for each: building, warming up and 5 frames; bare traversal of brdf
        };
        const dp::BenchResult result = dp::bench(scene, options);
        CHECK(calls == (both ? 15 : 8));
        CHECK(result.backend == dp::name_of(backend));
        CHECK(result.frames == 5);
        REQUIRE(result.integrators.size() == options.integrators.size());
        for (const dp::IntegratorBench& bench : result.integrators) {
            CHECK(bench.samples_per_second == Approx(1000 * 24 * 16 / bench.milliseconds));
            CHECK(bench.rays_per_second > bench.samples_per_second);
            const bool own_samples = bench.integrator != dp::Integrator::restir;
            CHECK(bench.bare_rays_per_second.has_value() == own_samples);
            CHECK(bench.share_of_bare.has_value() == own_samples);
        }
        CHECK(*result.integrators[0].cost_relative_to_brdf == 1);
        CHECK_THAT(result.text, Catch::Contains("bare Mray/s") && Catch::Contains("24x16"));
    }
}

TEST_CASE("bench stops, and refuses the oracle") {
    const dp::Scene scene = small_scene();
    dp::BenchOptions options;
    options.settings = small_settings();
    options.backend.backend = dp::Backend::oracle;
    CHECK_THROWS_AS(dp::bench(scene, options), dp::SettingError);
    options.backend.backend = dp::Backend::cpu;
    options.frames = 4;
    CHECK_THROWS_WITH(dp::bench(scene, options), Catch::Contains("frames 4"));
    options.frames = 5;
    std::stop_source stop;
    stop.request_stop();
    options.stop = stop.get_token();
    CHECK_THROWS_AS(dp::bench(scene, options), dp::Interrupted);
}
