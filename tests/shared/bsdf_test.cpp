#include "bsdf/bsdf.h"

#include <bit>

#include "catch.h"
#include "direction_chi_square.h"

using namespace diptych::core::shared;
using namespace diptych::core::tests;

namespace {

constexpr uint all_features = ~0u;

BsdfParameters metal(float roughness, uint model) {
    return bsdf_parameters(vec3(1.0f, 1.0f, 1.0f), 1.0f, roughness, 0.04f, 1.0f, vec3(1.0f, 1.0f, 1.0f), model);
}

BsdfParameters plastic(float roughness, uint model) {
    return bsdf_parameters(vec3(0.8f, 0.5f, 0.2f), 0.0f, roughness, 0.04f, 1.0f, vec3(1.0f, 1.0f, 1.0f), model);
}

bool is_finite(float x) {
    return x > -1e37f && x < 1e37f;
}

bool is_sane(const BsdfSample& s) {
    bool ok = is_finite(s.pdf) && s.pdf >= 0.0f && close(length(s.direction), 1.0, 1e-5);
    for (int i = 0; i < 3; ++i) {
        ok = ok && is_finite(s.weight[i]) && s.weight[i] >= -1e-6f;
    }
    return ok && (s.pdf > 0.0f || s.weight == vec3(0.0f, 0.0f, 0.0f));
}

bool same_bits(float a, float b) {
    return std::bit_cast<uint>(a) == std::bit_cast<uint>(b);
}
bool same_bits(vec3 a, vec3 b) {
    return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}

/// The GGX surface by the textbook, in double precision: glTF 2.0's appendix B with Smith's height-correlated masking.
double reference_eval(const BsdfParameters& p, int channel, vec3 wo, vec3 wi) {
    const double o[3] = {wo.x, wo.y, wo.z};
    const double i[3] = {wi.x, wi.y, wi.z};
    const double h[3] = {o[0] + i[0], o[1] + i[1], o[2] + i[2]};
    const double norm = std::sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
    const double v_dot_h = (o[0] * h[0] + o[1] * h[1] + o[2] * h[2]) / norm;
    const double tan2 = (h[0] * h[0] + h[1] * h[1]) / (h[2] * h[2]);
    const double cos4 = std::pow(h[2] / norm, 4.0);
    const double a2 = static_cast<double>(p.alpha) * p.alpha;
    const double d = 1.0 / (M_PI * a2 * cos4 * std::pow(1.0 + tan2 / a2, 2.0));
    const auto lambda = [a2](double c) { return 0.5 * (std::sqrt(1.0 + a2 * (1.0 / (c * c) - 1.0)) - 1.0); };
    const double g = 1.0 / (1.0 + lambda(o[2]) + lambda(i[2]));
    const double f0 = p.f0[channel];
    const double f = f0 + (static_cast<double>(p.f90[channel]) - f0) * std::pow(1.0 - v_dot_h, 5.0);
    return static_cast<double>(p.diffuse[channel]) * (1.0 - f) / M_PI * i[2] + f * d * g / (4.0 * o[2]);
}

}  // namespace

TEST_CASE("Parameters follow metallic-roughness and KHR_materials_specular") {
    const vec3 base(0.9f, 0.5f, 0.1f);
    BsdfParameters p = bsdf_parameters(base, 0.0f, 0.5f, 0.04f, 0.5f, vec3(1.0f, 50.0f, 0.0f), BRDF_GGX);
    CHECK(p.diffuse == base);
    CHECK(close(p.f0.x, 0.02, 1e-6));
    CHECK(p.f0.y == 0.5f);
    CHECK(p.f0.z == 0.0f);
    CHECK(p.f90 == vec3(0.5f, 0.5f, 0.5f));
    CHECK(p.alpha == 0.25f);
    p = bsdf_parameters(base, 1.0f, 1.0f, 0.04f, 0.5f, vec3(1.0f, 1.0f, 1.0f), BRDF_GGX);
    CHECK(p.diffuse == vec3(0.0f, 0.0f, 0.0f));
    CHECK(p.f0 == base);
    CHECK(p.f90 == vec3(1.0f, 1.0f, 1.0f));
    p = bsdf_parameters(base, 0.5f, 1.0f, 0.04f, 1.0f, vec3(1.0f, 1.0f, 1.0f), BRDF_GGX);
    CHECK(close(p.f0.x, 0.47, 1e-6));
    CHECK(close(p.diffuse.x, 0.45, 1e-6));
}

TEST_CASE("The mix equals the textbook's in double precision") {
    Uniforms u(21);
    double worst = 0.0;
    for (int k = 0; k < 200000; ++k) {
        const float metallic = u.next();
        const float roughness = 0.05f + 0.95f * u.next();
        BsdfParameters p =
            bsdf_parameters(vec3(0.8f, 0.5f, 0.2f), metallic, roughness, 0.04f, 0.7f, vec3(1.0f, 0.3f, 2.0f), BRDF_GGX);
        const vec3 wo = direction_at(1.0 - 0.99 * u.next(), 6.0 * u.next());
        const vec3 wi = direction_at(1.0 - 0.99 * u.next(), 6.0 * u.next());
        const vec3 f = bsdf_eval_local(p, wo, wi, all_features);
        for (int c = 0; c < 3; ++c) {
            const double expected = reference_eval(p, c, wo, wi);
            worst = std::max(worst, std::abs(static_cast<double>(f[c]) - expected) / (expected + 1e-4));
        }
    }
    CHECK(worst < 5e-4);
}

namespace {

void check_bsdf_draws(int64_t draws) {
    struct Case {
        const char* name;
        BsdfParameters p;
    };
    std::vector<Case> cases;
    for (const uint model : {BRDF_GGX, BRDF_BLINN_PHONG}) {
        cases.push_back({"rough metal", metal(0.5f, model)});
        cases.push_back({"rough plastic", plastic(1.0f, model)});
        cases.push_back({"glossy plastic", plastic(0.4f, model)});
    }
    cases.push_back({"diffuse below a mirror", plastic(0.0f, BRDF_GGX)});
    const double cosines[] = {1.0, 0.7, 0.1, 0.01};
    const int tests = static_cast<int>(cases.size() * std::size(cosines));
    uint32_t seed = 300;
    for (const Case& c : cases) {
        for (const double cosine : cosines) {
            const vec3 wo = direction_at(cosine, 0.45);
            Uniforms u(seed++);
            int64_t deltas = 0;
            int64_t inconsistent = 0;
            const auto draw = [&](vec3& wi) {
                const float u_lobe = u.next();
                const BsdfSample s = bsdf_sample_local(c.p, wo, u_lobe, u.next_pair(), all_features);
                wi = s.direction;
                if (s.delta != 0u) {
                    ++deltas;
                    return false;
                }
                if (s.pdf > 0.0f) {
                    const vec3 f = bsdf_eval_local(c.p, wo, wi, all_features);
                    const float pdf = bsdf_pdf_local(c.p, wo, wi, all_features);
                    for (int i = 0; i < 3; ++i) {
                        inconsistent += std::abs(s.weight[i] - f[i] / pdf) <= 1e-3 * s.weight[i] + 1e-6 ? 0 : 1;
                    }
                    inconsistent += close(s.pdf, pdf, 1e-3) ? 0 : 1;
                }
                return s.pdf > 0.0f;
            };
            const auto pdf = [&](vec3 wi) { return bsdf_pdf_local(c.p, wo, wi, all_features); };
            const ChiSquareResult r =
                chi_square(half_vector_chart(wo, std::max(0.2, static_cast<double>(c.p.alpha))), draws, draw, pdf);
            INFO(c.name << " model " << c.p.model << " cos " << cosine << " null " << r.null_fraction << " integral "
                        << r.pdf_integral);
            CHECK(r.impossible == 0);
            CHECK(inconsistent == 0);
            CHECK(r.quadrature < quadrature_limit);
            CHECK(r.p > sidak_threshold(tests));
            CHECK(std::abs(1.0 - r.null_fraction - r.pdf_integral) <
                  1e-3 + 2.0 * std::sqrt(0.25 / static_cast<double>(draws)));
            CHECK((deltas > 0) == (c.p.alpha == 0.0f));
        }
    }
}

}  // namespace

TEST_CASE("Directions are drawn with the density that the triple states") {
    check_bsdf_draws(120000);
}

TEST_CASE("A million directions are drawn with the density that the triple states", "[nightly]") {
    check_bsdf_draws(1000000);
}

TEST_CASE("The mean weight of samples is the directional albedo of the textbook") {
    for (const float roughness : {0.3f, 0.55f, 1.0f}) {
        for (const double cosine : {1.0, 0.7, 0.1}) {
            for (const bool is_metal : {false, true}) {
                const BsdfParameters p = is_metal ? metal(roughness, BRDF_GGX) : plastic(roughness, BRDF_GGX);
                const vec3 wo = direction_at(cosine, 0.45);
                const double alpha = static_cast<double>(p.alpha);
                double expected = 0.0;
                if (is_metal) {
                    expected = integrate(half_vector_chart(wo, alpha), 150,
                                         [&](vec3 wi) { return reference_eval(p, 0, wo, wi); });
                } else {
                    expected =
                        integrate(hemisphere_chart(), 250, [&](vec3 wi) { return reference_eval(p, 0, wo, wi); });
                }
                Uniforms u(400);
                double sum = 0.0;
                double squares = 0.0;
                constexpr int draws = 100000;
                for (int k = 0; k < draws; ++k) {
                    const float u_lobe = u.next();
                    const BsdfSample s = bsdf_sample_local(p, wo, u_lobe, u.next_pair(), all_features);
                    sum += static_cast<double>(s.weight.x);
                    squares += static_cast<double>(s.weight.x) * s.weight.x;
                }
                const double mean = sum / draws;
                const double error = std::sqrt((squares / draws - mean * mean) / draws);
                INFO("roughness " << roughness << " cos " << cosine << " metal " << is_metal << " mean " << mean
                                  << " expected " << expected);
                CHECK(std::abs(mean - expected) < 4.5 * error + 2e-3 * expected);
            }
        }
    }
}

TEST_CASE("A white metal's weights never exceed 1, as GGX draws visible normals") {
    Uniforms u(22);
    float largest = 0.0f;
    for (int k = 0; k < 200000; ++k) {
        const BsdfParameters p = metal(0.02f + 0.98f * u.next(), BRDF_GGX);
        const vec3 wo = direction_at(std::pow(10.0, -7.0 * u.next()), 6.0 * u.next());
        const float u_lobe = u.next();
        largest = std::max(largest, bsdf_sample_local(p, wo, u_lobe, u.next_pair(), all_features).weight.x);
    }
    CHECK(largest <= 1.0f + 1e-5f);
    CHECK(largest > 0.99f);
}

TEST_CASE("Reflection is reciprocal") {
    Uniforms u(23);
    double worst = 0.0;
    for (int k = 0; k < 100000; ++k) {
        const uint model = k % 2 == 0 ? BRDF_GGX : BRDF_BLINN_PHONG;
        BsdfParameters p = plastic(0.1f + 0.9f * u.next(), model);
        const vec3 wo = direction_at(1.0 - 0.999 * u.next(), 6.0 * u.next());
        const vec3 wi = direction_at(1.0 - 0.999 * u.next(), 6.0 * u.next());
        const double there = static_cast<double>(bsdf_eval_local(p, wo, wi, all_features).x) / wi.z;
        const double back = static_cast<double>(bsdf_eval_local(p, wi, wo, all_features).x) / wo.z;
        worst = std::max(worst, std::abs(there - back) / there);
    }
    CHECK(worst < 1e-4);
}

TEST_CASE("Every input gives finite values, and black surfaces give null samples") {
    const float ends[] = {0.0f, 0x1p-24f, 0.5f, 1.0f - 0x1p-24f};
    const vec3 colors[] = {vec3(0.0f, 0.0f, 0.0f), vec3(1.0f, 1.0f, 1.0f), vec3(1.0f, 0.0f, 0.0f)};
    int64_t bad = 0;
    int64_t samples = 0;
    for (const uint model : {BRDF_GGX, BRDF_BLINN_PHONG}) {
        for (const float roughness : {0.0f, 0.0099f, 0.0101f, 0.03f, 0.5f, 1.0f, 2.0f}) {
            for (const float metallic : {0.0f, 0.5f, 1.0f}) {
                for (const float f0 : {0.0f, 0.04f, 1.0f}) {
                    for (const vec3 color : colors) {
                        for (const float specular : {0.0f, 1.0f}) {
                            const BsdfParameters p = bsdf_parameters(color, metallic, roughness, f0, specular,
                                                                     vec3(1.0f, 1.0f, 1.0f), model);
                            const bool black = p.diffuse == colors[0] && p.f0 == colors[0] && p.f90 == colors[0];
                            for (const double cosine : {-0.5, 0.0, 1e-8, 1.1e-7, 1e-5, 1e-3, 0.5, 1.0}) {
                                const vec3 wo = direction_at(cosine, 0.45);
                                for (const float u_lobe : ends) {
                                    for (const float x : ends) {
                                        for (const float y : ends) {
                                            const BsdfSample s =
                                                bsdf_sample_local(p, wo, u_lobe, vec2(x, y), all_features);
                                            const float pdf = bsdf_pdf_local(p, wo, s.direction, all_features);
                                            const vec3 f = bsdf_eval_local(p, wo, s.direction, all_features);
                                            const bool null_due = black || wo.z <= COS_MIN;
                                            ++samples;
                                            bad += is_sane(s) && is_finite(pdf) && pdf >= 0.0f && is_finite(f.x) &&
                                                           is_finite(f.y) && f.x >= -1e-6f &&
                                                           (!null_due || s.pdf == 0.0f)
                                                       ? 0
                                                       : 1;
                                        }
                                    }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
    INFO(samples << " samples");
    CHECK(bad == 0);
}

TEST_CASE("Below the least roughness a surface is a mirror, apart from its diffuse light") {
    const BsdfParameters p = metal(0.0f, BRDF_GGX);
    CHECK(bsdf_is_purely_delta(p, all_features));
    CHECK_FALSE(bsdf_is_purely_delta(plastic(0.0f, BRDF_GGX), all_features));
    CHECK_FALSE(bsdf_is_purely_delta(metal(0.5f, BRDF_GGX), all_features));
    const vec3 wo = direction_at(0.6, 0.45);
    const BsdfSample s = bsdf_sample_local(p, wo, 0.3f, vec2(0.2f, 0.7f), all_features);
    CHECK(s.delta == 1u);
    CHECK(s.pdf == 1.0f);
    CHECK(s.direction == vec3(-wo.x, -wo.y, wo.z));
    CHECK(s.weight == vec3(1.0f, 1.0f, 1.0f));
    CHECK(bsdf_pdf_local(p, wo, s.direction, all_features) == 0.0f);
    CHECK(bsdf_eval_local(p, wo, s.direction, all_features) == vec3(0.0f, 0.0f, 0.0f));
    // Just above, the narrow lobe reflects as much: continuous across the switch.
    double sum = 0.0;
    Uniforms u(24);
    for (int k = 0; k < 20000; ++k) {
        sum += bsdf_sample_local(metal(0.0101f, BRDF_GGX), wo, 0.3f, u.next_pair(), all_features).weight.x;
    }
    CHECK(close(sum / 20000.0, 1.0, 1e-3));
}

TEST_CASE("Features that the data does not use change no bit") {
    Uniforms u(25);
    int64_t different = 0;
    for (int k = 0; k < 100000; ++k) {
        const bool blinn_phong = k % 2 == 0;
        const bool mirror = k % 5 == 0;
        const uint features = (blinn_phong ? FEATURE_BLINN_PHONG : FEATURE_GGX) | (mirror ? FEATURE_MIRRORS : 0u);
        const float roughness = mirror ? 0.0f : 0.011f + 0.98f * u.next();
        BsdfParameters p = plastic(roughness, blinn_phong ? BRDF_BLINN_PHONG : BRDF_GGX);
        if (k % 3 == 0) {
            p = metal(roughness, p.model);
        }
        const vec3 wo = direction_at(1.0 - u.next(), 6.0 * u.next());
        const vec3 wi = direction_at(1.0 - u.next(), 6.0 * u.next());
        const float u_lobe = u.next();
        const vec2 facet = u.next_pair();
        const BsdfSample a = bsdf_sample_local(p, wo, u_lobe, facet, features);
        const BsdfSample b = bsdf_sample_local(p, wo, u_lobe, facet, all_features);
        const bool same = same_bits(a.direction, b.direction) && same_bits(a.weight, b.weight) &&
                          same_bits(a.pdf, b.pdf) && a.delta == b.delta &&
                          same_bits(bsdf_eval_local(p, wo, wi, features), bsdf_eval_local(p, wo, wi, all_features)) &&
                          same_bits(bsdf_pdf_local(p, wo, wi, features), bsdf_pdf_local(p, wo, wi, all_features));
        different += same ? 0 : 1;
    }
    CHECK(different == 0);
}
