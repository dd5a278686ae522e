#include "restir/reuse_surface.h"

#include <algorithm>
#include <cmath>

#include "catch.h"
#include "direction_chi_square.h"
#include "known_values.h"

using namespace diptych::core::shared;
using namespace diptych::core::tests;

namespace {

SurfaceBsdf turned(const BsdfParameters& p, vec3 normal) {
    SurfaceBsdf s;
    s.parameters = p;
    s.geometric_normal = normal;
    s.shading_normal = normal;
    s.mapped_normal = normal;
    s.mapped = 0u;
    return s;
}

/// A unit direction within the angle whose cosine is `least` about `axis`.
vec3 around(vec3 axis, double least, Uniforms& u) {
    const Frame frame = frame_from_normal(axis);
    return to_world(frame, direction_at(least + (1.0 - least) * u.next(), 2.0 * M_PI * u.next()));
}

/// The largest |ln(f cos / target)| between what a surface reflects and its packed target.
double largest_log_ratio(double alpha, bool reusable, std::uint32_t seed) {
    Uniforms u(seed);
    double largest = 0;
    int compared = 0;
    for (int k = 0; k < 20000; ++k) {
        const vec3 normal = direction_at(2.0 * u.next() - 1.0, 2.0 * M_PI * u.next());
        const SurfaceBsdf s = turned(
            bsdf_parameters(white, 1.0f, static_cast<float>(std::sqrt(alpha)), 0.0f, 1.0f, white, BRDF_GGX), normal);
        const vec3 wo = around(normal, 0.02, u);
        const vec2 u_lobe = u.next_pair();
        const BsdfSample sample = surface_bsdf_sample(s, wo, u_lobe, u.next_pair(), ~0u);
        if (!(sample.pdf > 0.0f) || dot(sample.direction, normal) < 0.05f || (reusable && !wants_reuse(s, wo))) {
            continue;
        }
        ++compared;
        const float truth = surface_bsdf_eval(s, wo, sample.direction, ~0u).x;
        const TargetSurface packed = unpack_reuse_surface(pack_reuse_surface(vec3(0.0f, 0.0f, 0.0f), s, wo), ~0u);
        const float target = target_reflectance(packed, sample.direction).x;
        largest = std::max(largest, std::abs(std::log(static_cast<double>(truth) / static_cast<double>(target))));
    }
    REQUIRE(compared > 5000);
    return largest;
}

}  // namespace

// Octahedral rounding turns the normal and wo by up to 4e-5 each, the half vector by 1 / (2 cos) of that of wo, and ln
// D moves by at most 2 / alpha for it; alpha itself is rounded to 1/65535, for twice that in ln D.
TEST_CASE("Where neighbours may reuse a surface, its packed target follows what it reflects") {
    for (const double alpha : {1.001 * static_cast<double>(TARGET_ALPHA_MIN), 0.0025, 0.005, 0.02, 0.1, 0.5}) {
        CAPTURE(alpha);
        CHECK(largest_log_ratio(alpha, true, 7) <
              0.01 + 2e-4 / std::max(0.02 * alpha, 0.5 * static_cast<double>(TARGET_ALPHA_MIN)));
    }
    // The target of a lobe that had to be widened lies below its peak by the square of the ratio of the widths.
    CHECK(largest_log_ratio(0.25 * static_cast<double>(TARGET_ALPHA_MIN), false, 8) > std::log(8.0));
}
