// Resampling of light points: what is kept, how often, and with which weight.
#include "restir/reservoir.h"

#include <array>
#include <limits>

#include "catch.h"
#include "numbers/rng.h"
#include "stats/chi_square.h"

using namespace diptych::core::shared;
using diptych::core::chi_square_deviate;
using diptych::core::chi_square_fit;
using diptych::core::deviate_limit;

namespace {

LightPoint point_on(uint light) {
    LightPoint y = no_light_point();
    y.light = light;
    return y;
}

struct Candidate {
    float target;
    float weight;
    float favor;
};

}  // namespace

TEST_CASE("Candidates are kept in proportion to weight times favor, and W gives the favor back") {
    const std::array<Candidate, 4> candidates{{{2, 0.5f, 1}, {0.25f, 2, 0.5f}, {1, 0.25f, 1}, {8, 3, 0.5f}}};
    const double sum = 0.5 + 2 * 0.5 + 0.25 + 3 * 0.5;
    constexpr uint samples = 40000;
    std::vector<double> observed(candidates.size(), 0);
    std::vector<double> expected;
    for (const Candidate& c : candidates) {
        expected.push_back(samples * static_cast<double>(c.weight * c.favor) / sum);
    }
    for (uint n = 0; n < samples; n++) {
        Resampling s = begin_resampling();
        for (uint i = 0; i < candidates.size(); i++) {
            const Candidate& c = candidates[i];
            add_favored_candidate(s, point_on(i), c.target, c.weight, c.favor, unit_float(pcg4d(uvec4(n, i, 3, 4)).x));
        }
        const Reservoir r = end_resampling(s, 0.5f, 7.0f);
        REQUIRE(r.point.light < candidates.size());
        const Candidate& kept = candidates[r.point.light];
        observed[r.point.light] += 1;
        REQUIRE(r.target == kept.target);
        REQUIRE(r.favor == kept.favor);
        REQUIRE(r.confidence == 7.0f);
        REQUIRE(static_cast<double>(r.weight) == Approx(0.5 * sum / static_cast<double>(kept.target * kept.favor)).epsilon(1e-6));
    }
    CHECK(chi_square_deviate(chi_square_fit(observed, expected)) < deviate_limit);
}

TEST_CASE("What has no target, or no positive finite weight, is passed over, and nothing kept weighs nothing") {
    const float infinite = std::numeric_limits<float>::infinity();
    const float undefined = std::numeric_limits<float>::quiet_NaN();
    Resampling s = begin_resampling();
    for (const auto& [target, weight] : {std::pair{0.0f, 1.0f}, {-1.0f, 1.0f}, {0.1f * TARGET_MIN, 1.0f}, {undefined, 1.0f},
                                         {1.0f, 0.0f}, {1.0f, -1.0f}, {1.0f, infinite}, {1.0f, undefined}}) {
        add_candidate(s, point_on(3), target, weight, 0.0f);
    }
    const Reservoir nothing = end_resampling(s, 1.0f, 2.0f);
    CHECK(nothing.point.light == NONE);
    CHECK(nothing.weight == 0.0f);
    CHECK(nothing.confidence == 2.0f);
    add_candidate(s, point_on(5), 4.0f, 2.0f, 0.999f);
    const Reservoir one = end_resampling(s, 1.0f, 2.0f);
    CHECK(one.point.light == 5);
    CHECK(one.weight == 0.5f);
}

TEST_CASE("A reservoir is merged by share, target here and its own W") {
    Reservoir r = empty_reservoir();
    r.point = point_on(2);
    r.weight = 3;
    r.target = 100;  // where it was made, of which the merge asks nothing
    r.favor = 0.5f;
    Resampling s = begin_resampling();
    add_reservoir(s, r, 5.0f, 0.25f, 0.0f);
    CHECK(s.weight_sum == 0.5f * 0.25f * 5 * 3);
    const Reservoir merged = end_resampling(s, 1.0f, 1.0f);
    CHECK(merged.target == 5.0f);
    CHECK(merged.weight == 0.25f * 3);
    CHECK(merged.favor == 0.5f);
}

TEST_CASE("Shares of pairwise MIS add up to 1 at every point, and each is what its formula says") {
    const std::array<double, 3> confidences{4, 1, 9};
    const std::array<double, 3> targets{0.5, 0, 3};  // of one point at the neighbours
    const double own_confidence = 2;
    const double own_target = 0.7;
    const double s = 4 + 1 + 9;
    double sum = own_confidence / (s + own_confidence);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto f = [](double x) { return static_cast<float>(x); };
        const double neighbor = static_cast<double>(
            pairwise_neighbor_share(f(confidences[i]), f(targets[i]), f(own_confidence), f(own_target), f(s)));
        const double canonical = static_cast<double>(
            pairwise_canonical_share(f(confidences[i]), f(targets[i]), f(own_confidence), f(own_target), f(s)));
        const double both = s * targets[i] + own_confidence * own_target;
        CHECK(neighbor == Approx(confidences[i] / (s + own_confidence) * (s * targets[i] / both)));
        CHECK(canonical == Approx(confidences[i] / (s + own_confidence) * (own_confidence * own_target / both)));
        sum += neighbor + canonical;
    }
    CHECK(sum == Approx(1));
    CHECK(pairwise_neighbor_share(1, 0, 1, 0, 1) == 0.0f);
    CHECK(pairwise_canonical_share(1, 0, 1, 0, 1) == 0.0f);
}
