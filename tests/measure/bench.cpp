#include "catch.h"

#include "fixture.h"
#include "measure/bench.h"

using namespace diptych::core;
using namespace diptych::core::measure_tests;

namespace {

struct Counted {
    std::optional<BenchResult> result;
    int steps = 0;
};

/// Cancelled as that step begins; never for 0.
Counted bench(const BenchSettings& settings, int cancel_at = 0) {
    const Scene scene = cornell();
    std::atomic<bool> cancel = false;
    Counted counted;
    counted.result = bench_integrators(settings, scene, small_request(), open_on_cpu, cancel, [&](const std::string&) {
        cancel = ++counted.steps == cancel_at || cancel;
    });
    return counted;
}

}  // namespace

TEST_CASE("The engine of bench gives figures of every integrator, in the order that was asked for") {
    const BenchSettings settings{{Integrator::path, Integrator::restir, Integrator::brdf}, 2, 5};
    const Counted counted = bench(settings);
    CHECK(counted.steps == bench_steps(settings));
    REQUIRE(counted.result);
    CHECK(counted.result->backend == "cpu");
    REQUIRE(counted.result->integrators.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        const IntegratorBench& figures = counted.result->integrators[i];
        CHECK(figures.integrator == settings.integrators[i]);
        CHECK(figures.bare.has_value() == !resamples(figures.integrator));
        CHECK(figures.passes.empty() == !resamples(figures.integrator));
        CHECK(figures.samples_per_second * figures.milliseconds / 1000 == Approx(16 * 16));
        CHECK(figures.rays_per_second > 0);
        CHECK(figures.costs.bytes > 0);
    }
    const double ratio = counted.result->integrators[0].milliseconds / counted.result->integrators[2].milliseconds;
    CHECK(counted.result->integrators[0].cost_relative_to_brdf.value() == Approx(ratio));
    CHECK(counted.result->integrators[2].cost_relative_to_brdf.value() == 1);
}

TEST_CASE("The engine of bench knows no cost relative to brdf where brdf is not measured") {
    const Counted counted = bench({{Integrator::path}, 1, 5});
    REQUIRE(counted.result);
    CHECK_FALSE(counted.result->integrators.front().cost_relative_to_brdf.has_value());
}

TEST_CASE("The engine of bench stops at the step at which it is cancelled, with the frames that all integrators have") {
    const BenchSettings settings{{Integrator::brdf, Integrator::path}, 1, 5};
    const int warm = 4;
    struct Case {
        int step;
        int frames;
    };
    for (const auto& [step, frames] : {Case{1, 0}, Case{warm + 2, 0}, Case{warm + 3, 1}, Case{bench_steps(settings), 5}}) {
        const Counted counted = bench(settings, step);
        INFO("cancelled at step " << step);
        CHECK(counted.steps == step);
        REQUIRE(counted.result.has_value() == (frames > 0));
        if (frames > 0) {
            CHECK(counted.result->frames == frames);
            REQUIRE(counted.result->integrators.size() == 2);
            const IntegratorBench& brdf = counted.result->integrators[0];
            CHECK(brdf.samples_per_second * brdf.milliseconds / 1000 == Approx(16 * 16));
            CHECK(brdf.rays_per_second / brdf.samples_per_second >= 1);
            CHECK(brdf.rays_per_second / brdf.samples_per_second < 20);
        }
    }
}
