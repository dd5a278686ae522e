#include "catch.h"

#include <atomic>

#include "fixture.h"
#include "measure/verify_suite.h"

using namespace diptych::core;
using namespace diptych::core::measure_tests;

namespace {

constexpr int runs_per_side = 3;
constexpr int sides = 3;  // brdf, path as the reference of both, direct: in this order

struct Suite {
    std::optional<SuiteResult> result;
    int begun = 0;  // runs of a side
};

/// Cancelled as that run of a side begins; never for 0.
Suite verify(VerifySettings settings, int cancel_at = 0) {
    const Scene scene = cornell();
    const SideName path{"cpu", Integrator::path, ""};
    const std::vector<PairName> pairs = {{{"cpu", Integrator::brdf, ""}, path, {}},
                                         {{"cpu", Integrator::direct, ""}, path, {}}};
    settings.runs = runs_per_side;
    std::atomic<bool> cancel = false;
    Suite suite;
    suite.result = run_suite(settings, {scene, small_request(), open_on_cpu}, pairs, 1, cancel,
                             [&](const SideName&, std::uint32_t) { cancel = ++suite.begun == cancel_at || cancel; });
    return suite;
}

}  // namespace

TEST_CASE("The engine of verify that is cancelled has the pairs whose sides were rendered") {
    VerifySettings settings;
    settings.spp = 2;
    const Suite whole = verify(settings);
    REQUIRE(whole.result);
    CHECK(whole.begun == sides * runs_per_side);
    CHECK_FALSE(whole.result->interrupted);
    REQUIRE(whole.result->pairs.size() == 2);
    // The last run of the first side, and of the second: no pair is whole.
    for (const int run : {3, 6}) {
        CHECK_FALSE(verify(settings, run).result.has_value());
    }
    for (const int run : {7, 9}) {
        INFO("cancelled in run " << run);
        const Suite stopped = verify(settings, run);
        CHECK(stopped.begun == run);
        REQUIRE(stopped.result);
        CHECK(stopped.result->interrupted);
        REQUIRE(stopped.result->pairs.size() == 1);
        CHECK(stopped.result->pairs[0].names.a.integrator == Integrator::brdf);
        CHECK(stopped.result->pairs[0].comparison.bias_percent == whole.result->pairs[0].comparison.bias_percent);
        CHECK(stopped.result->pairs[0].comparison.global_p == whole.result->pairs[0].comparison.global_p);
    }
}

TEST_CASE("The engine of verify that is cancelled while it doubles its samples has those of the round before") {
    VerifySettings settings;
    settings.seconds = 1e6;
    settings.max_half_width = 1e-9;  // so that it never ends by itself
    const Suite first = verify(settings, sides * runs_per_side + 1);
    REQUIRE(first.result);
    CHECK(first.result->interrupted);
    REQUIRE(first.result->pairs.size() == 2);
    VerifySettings four;
    four.spp = 4;
    const Suite fixed = verify(four);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(first.result->pairs[i].spp == 4);
        CHECK(first.result->pairs[i].spp_b == 4);
        CHECK(first.result->pairs[i].comparison.bias_percent == fixed.result->pairs[i].comparison.bias_percent);
    }
    // One side further on than the others.
    const Suite second = verify(settings, sides * runs_per_side + 4);
    REQUIRE(second.result);
    CHECK(second.result->pairs[0].spp == 8);
    CHECK(second.result->pairs[0].spp_b == 4);
    CHECK(second.result->pairs[1].spp == 4);
}
