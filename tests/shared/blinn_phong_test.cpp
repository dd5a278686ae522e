#include "bsdf/blinn_phong.h"

#include "catch.h"
#include "direction_chi_square.h"

using namespace diptych::core::shared;
using namespace diptych::core::tests;

namespace {

const double phong_alphas[] = {1.0, 0.3, 0.1, 0.03, 0.01, 1e-3};
const double phong_cosines[] = {1.0, 0.7, 0.1, 0.01};

/// Smith's Lambda of the slopes' Student-t marginal, by quadrature in double precision.
double exact_lambda(double cosine, double alpha) {
    const double n = 2.0 / (alpha * alpha) - 2.0;
    const double mu = cosine / std::sqrt(1.0 - cosine * cosine);
    const double scale = std::exp(std::lgamma(0.5 * (n + 3.0)) - std::lgamma(0.5 * (n + 2.0))) / std::sqrt(M_PI);
    const double low = std::atan(mu / alpha);
    constexpr int steps = 4000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double t = low + (0.5 * M_PI - low) * (i + 0.5) / steps;
        const double m = alpha * std::tan(t);
        sum += (m - mu) * std::exp(-0.5 * (n + 3.0) * std::log1p(m * m)) * alpha / (std::cos(t) * std::cos(t));
    }
    return scale * sum * (0.5 * M_PI - low) / steps / mu;
}

double directional_albedo(vec3 wo, double alpha) {
    const float a = static_cast<float>(alpha);
    return integrate(half_vector_chart(wo, alpha), 120,
                     [&](vec3 wi) { return blinn_phong_eval(wo, wi, normalize(wo + wi), a); });
}

}  // namespace

TEST_CASE("Blinn-Phong D is normalised for exponents from 0 to 1e5") {
    for (const double n : {0.0, 0.5, 1.0, 3.0, 10.0, 100.0, 1e3, 1e4, 1e5}) {
        const double alpha = std::sqrt(2.0 / (n + 2.0));
        const float a = static_cast<float>(alpha);
        double sum = 0.0;
        constexpr int steps = 20000;
        for (int i = 0; i < steps; ++i) {
            const double x = (i + 0.5) / steps;
            const double t = alpha * alpha * x / (1.0 - x);
            const double c = 1.0 / std::sqrt(1.0 + t);
            const vec3 h(static_cast<float>(std::sqrt(t) * c), 0.0f, static_cast<float>(c));
            sum += blinn_phong_d(h, a) * c * M_PI * c * c * c * alpha * alpha / ((1.0 - x) * (1.0 - x));
        }
        INFO("n " << n);
        CHECK(close(sum / steps, 1.0, 1e-4));
    }
}

TEST_CASE("Blinn-Phong D equals its value in double precision down to alpha 1e-4") {
    Uniforms u(12);
    for (const double alpha : {1.0, 0.9, 0.1, 1e-2, 1e-3, 1e-4}) {
        double worst = 0.0;
        const double a = static_cast<float>(alpha);
        const double n = 2.0 / (a * a) - 2.0;
        for (int k = 0; k < 100000; ++k) {
            const double t = alpha * alpha * std::pow(10.0, 5.0 * u.next() - 4.0);
            const double c = 1.0 / std::sqrt(1.0 + t);
            const vec3 h(static_cast<float>(std::sqrt(t) * c), 0.0f, static_cast<float>(c));
            const double log_cos2 = c * c < 0.5 ? 2.0 * std::log(h.z) : std::log1p(-static_cast<double>(h.x) * h.x);
            const double expected = (n + 2.0) / (2.0 * M_PI) * std::exp(0.5 * n * log_cos2);
            worst = std::max(worst, std::abs(blinn_phong_d(h, static_cast<float>(alpha)) / expected - 1.0));
        }
        INFO("alpha " << alpha);
        CHECK(worst < 5e-6);
    }
}

TEST_CASE("Blinn-Phong masking is the Smith term of its slopes, and GGX's at alpha 1") {
    for (const double alpha : {1.0, 0.9, 0.8, 0.6, 0.4, 0.3, 0.1, 0.01}) {
        for (const double cosine : {0.95, 0.7, 0.5, 0.3, 0.1, 0.03, 0.01}) {
            const vec3 w = direction_at(cosine, 1.0);
            const double exact = 1.0 / (1.0 + exact_lambda(cosine, alpha));
            INFO("alpha " << alpha << " cos " << cosine);
            CHECK(std::abs(blinn_phong_g1(w, static_cast<float>(alpha)) - exact) < (alpha == 1.0 ? 1e-5 : 0.01));
        }
    }
}

TEST_CASE("Blinn-Phong reflects no more than it receives") {
    for (const double alpha : {1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 0.03, 0.01, 1e-3}) {
        for (const double cosine : {1.0, 0.7, 0.4, 0.2, 0.1, 0.05, 0.02, 0.01, 1e-3}) {
            const double albedo = directional_albedo(direction_at(cosine, 0.45), alpha);
            INFO("alpha " << alpha << " cos " << cosine << " albedo " << albedo);
            CHECK(albedo < 1.001);
            CHECK(albedo > 0.3);
        }
    }
}

namespace {

void check_blinn_phong_draws(int64_t draws) {
    const int tests = static_cast<int>(std::size(phong_alphas) * std::size(phong_cosines));
    uint32_t seed = 100;
    for (const double alpha : phong_alphas) {
        for (const double cosine : phong_cosines) {
            const float a = static_cast<float>(alpha);
            const vec3 wo = direction_at(cosine, 0.45);
            Uniforms u(seed++);
            const auto draw = [&](vec3& wi) {
                const vec3 h = sample_blinn_phong_normal(a, u.next_pair());
                wi = 2.0f * dot(wo, h) * h - wo;
                return dot(wo, h) > 0.0f && wi.z > 0.0f;
            };
            const auto pdf = [&](vec3 wi) {
                return pdf_blinn_phong_solid_angle(0.5f * length(wo + wi), normalize(wo + wi), a);
            };
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

TEST_CASE("Blinn-Phong draws directions with the density it states, and loses those below the horizon") {
    check_blinn_phong_draws(300000);
}

TEST_CASE("A million Blinn-Phong draws have the density it states", "[nightly]") {
    check_blinn_phong_draws(1000000);
}

TEST_CASE("Blinn-Phong facets are unit and finite at the ends of their inputs") {
    for (const float alpha : {1e-4f, 1e-3f, 0.3f, 0.55f, 1.0f}) {
        for (const float y : {0.0f, 0x1p-24f, 0.25f, 0.5f, 1.0f - 0x1p-24f, 1.0f}) {
            const vec3 h = sample_blinn_phong_normal(alpha, vec2(0.3f, y));
            CHECK(close(length(h), 1.0, 1e-6));
            CHECK(h.z > 0.0f);
        }
        for (const double cosine : {1e-7, 1e-5, 1.0}) {
            const float g = blinn_phong_g1(direction_at(cosine, 0.0), alpha);
            CHECK((g > 0.0f && g <= 1.0f));
        }
    }
}
