#include "bsdf/ggx.h"

#include "catch.h"
#include "direction_chi_square.h"

using namespace diptych::core::shared;
using namespace diptych::core::tests;

namespace {

const double alphas[] = {1.0, 0.3, 0.1, 0.03, 0.01, 1e-3};
const double cosines[] = {1.0, 0.7, 0.1, 0.01};

double textbook_d(vec3 h, double alpha) {
    const double s2 = static_cast<double>(h.x) * h.x + static_cast<double>(h.y) * h.y;
    const double c2 = static_cast<double>(h.z) * h.z;
    const double tan2 = s2 / c2;
    return alpha * alpha / (M_PI * c2 * c2 * std::pow(alpha * alpha + tan2, 2.0));
}

double textbook_lambda(double cosine, double alpha) {
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * (1.0 / (cosine * cosine) - 1.0)) - 1.0);
}

}  // namespace

TEST_CASE("GGX D equals its value in double precision down to alpha 1e-4") {
    Uniforms u(11);
    for (const double alpha : {1.0, 0.1, 1e-2, 1e-3, 1e-4}) {
        double worst = 0.0;
        for (int k = 0; k < 100000; ++k) {
            const double t = alpha * alpha * std::pow(10.0, 8.0 * u.next() - 4.0);
            const double c = 1.0 / std::sqrt(1.0 + t);
            const double phi = 2.0 * M_PI * u.next();
            const vec3 h(static_cast<float>(std::sqrt(t) * c * std::cos(phi)),
                         static_cast<float>(std::sqrt(t) * c * std::sin(phi)), static_cast<float>(c));
            const double expected = textbook_d(h, static_cast<float>(alpha));
            worst = std::max(worst, std::abs(ggx_d(h, static_cast<float>(alpha)) / expected - 1.0));
        }
        INFO("alpha " << alpha);
        CHECK(worst < 1.5e-6);
    }
    CHECK(ggx_d(vec3(0.6f, 0.0f, -0.8f), 0.5f) == 0.0f);
}

TEST_CASE("GGX from cosines is GGX from directions") {
    Uniforms u(13);
    for (const double alpha : alphas) {
        double worst = 0.0;
        for (int k = 0; k < 100000; ++k) {
            const auto a = static_cast<float>(alpha);
            const vec3 o = direction_at(std::max(static_cast<double>(u.next()), 1e-3), 2.0 * M_PI * u.next());
            const vec3 h = sample_ggx_visible_normal(o, a, vec2(float(u.next()), float(u.next())));
            const vec3 i = 2.0f * dot(o, h) * h - o;
            if (i.z < 1e-3f) {
                continue;
            }
            const float expected = ggx_eval(o, i, h, a);
            const float value = ggx_eval_of_cosines(o.z, i.z, h.z, h.x * h.x + h.y * h.y, a);
            worst = std::max(worst, static_cast<double>(std::abs(value / expected - 1.0f)));
        }
        INFO("alpha " << alpha);
        CHECK(worst < 5e-6);
    }
}

TEST_CASE("GGX masking equals Heitz's Lambda in double precision") {
    for (const double alpha : alphas) {
        for (const double co : {1.0, 0.7, 0.1, 0.01, 1e-4, 1e-7}) {
            const vec3 o = direction_at(co, 0.3);
            const double lambda_o = textbook_lambda(o.z, alpha);
            const float a = static_cast<float>(alpha);
            CHECK(close(ggx_g1(o, a), 1.0 / (1.0 + lambda_o), 2e-6));
            for (const double ci : {0.9, 0.05, 1e-7}) {
                const vec3 i = direction_at(ci, 2.0);
                const double expected = 1.0 / (1.0 + lambda_o + textbook_lambda(i.z, alpha));
                CHECK(close(ggx_g2(o, i, a), expected, 2e-6));
                CHECK(close(ggx_weight(o, i, a), expected * (1.0 + lambda_o), 3e-6));
                CHECK(ggx_weight(o, i, a) <= 1.0f);
            }
        }
    }
}

TEST_CASE("GGX keeps Heitz's identities") {
    for (const double alpha : alphas) {
        const float a = static_cast<float>(alpha);
        INFO("alpha " << alpha);
        CHECK(close(integrate_facets(alpha, 150, [&](vec3 h) { return ggx_d(h, a) * h.z; }), 1.0, 1e-4));
        for (const double cosine : cosines) {
            const vec3 wo = direction_at(cosine, 0.45);
            INFO("cos " << cosine);
            CHECK(close(integrate_facets(alpha, 150, [&](vec3 h) { return pdf_ggx_visible_normal(wo, h, a); }), 1.0,
                        1e-3));
        }
    }
    // The weak white furnace, over the whole sphere of wi.
    for (const double alpha : {1.0, 0.5, 0.3}) {
        for (const double cosine : {1.0, 0.7, 0.3}) {
            const vec3 wo = direction_at(cosine, 0.45);
            const float a = static_cast<float>(alpha);
            double sum = 0.0;
            constexpr int n = 700;
            for (int i = 0; i < n; ++i) {
                for (int j = 0; j < 2 * n; ++j) {
                    const vec3 wi = direction_at(2.0 * (i + 0.5) / n - 1.0, M_PI * (j + 0.5) / n);
                    const vec3 h = normalize(wo + wi);
                    sum += ggx_g1(wo, a) * ggx_d(h, a) / (4.0f * wo.z);
                }
            }
            CHECK(close(sum * 4.0 * M_PI / (2.0 * n * n), 1.0, 1e-3));
        }
    }
}

TEST_CASE("GGX of alpha 1 seen head-on reflects 1 - ln 2, and never more than it receives") {
    for (const double alpha : alphas) {
        for (const double cosine : cosines) {
            const vec3 wo = direction_at(cosine, 0.45);
            const float a = static_cast<float>(alpha);
            const double albedo = integrate(half_vector_chart(wo, alpha), 150,
                                            [&](vec3 wi) { return ggx_eval(wo, wi, normalize(wo + wi), a); });
            INFO("alpha " << alpha << " cos " << cosine << " albedo " << albedo);
            CHECK(albedo < 1.0 + 2e-3);
            CHECK((alpha < 1.0 || cosine < 1.0 || close(albedo, 1.0 - std::log(2.0), 1e-4)));
        }
    }
}

namespace {

void check_ggx_draws(int64_t draws) {
    const int tests = static_cast<int>(std::size(alphas) * std::size(cosines));
    uint32_t seed = 1;
    for (const double alpha : alphas) {
        for (const double cosine : cosines) {
            const float a = static_cast<float>(alpha);
            const vec3 wo = direction_at(cosine, 0.45);
            Uniforms u(seed++);
            const auto draw = [&](vec3& wi) {
                const vec3 h = sample_ggx_visible_normal(wo, a, u.next_pair());
                wi = 2.0f * dot(wo, h) * h - wo;
                return wi.z > 0.0f;
            };
            const auto pdf = [&](vec3 wi) { return pdf_ggx_solid_angle(wo, normalize(wo + wi), a); };
            const ChiSquareResult r = chi_square(half_vector_chart(wo, alpha), draws, draw, pdf);
            INFO("alpha " << alpha << " cos " << cosine << " null " << r.null_fraction << " integral "
                          << r.pdf_integral);
            CHECK(r.impossible == 0);
            CHECK(r.quadrature < quadrature_limit);
            CHECK(r.p > sidak_threshold(tests));
            CHECK(std::abs(1.0 - r.null_fraction - r.pdf_integral) <
                  1e-3 + 2.0 * std::sqrt(0.25 / static_cast<double>(draws)));
        }
    }
}

}  // namespace

TEST_CASE("GGX draws directions with the density it states, and loses those below the horizon") {
    check_ggx_draws(300000);
}

TEST_CASE("A million GGX draws have the density it states", "[nightly]") {
    check_ggx_draws(1000000);
}

TEST_CASE("GGX stays finite at the ends of its inputs") {
    for (const float alpha : {1e-4f, 1e-3f, 1.0f}) {
        for (const double cosine : {1e-7, 1e-5, 0.5, 1.0}) {
            const vec3 wo = direction_at(cosine, 0.45);
            for (const float x : {0.0f, 0x1p-24f, 0.5f, 1.0f - 0x1p-24f}) {
                for (const float y : {0.0f, 0x1p-24f, 0.5f, 1.0f - 0x1p-24f}) {
                    const vec3 h = sample_ggx_visible_normal(wo, alpha, vec2(x, y));
                    CHECK(close(length(h), 1.0, 1e-6));
                    CHECK(h.z > 0.0f);
                    CHECK(dot(wo, h) > -2e-7f);
                    const float pdf = pdf_ggx_solid_angle(wo, h, alpha);
                    CHECK((pdf > 0.0f && pdf < 1e20f));
                }
            }
        }
    }
}
