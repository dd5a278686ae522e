#include "bsdf/fresnel.h"

#include "catch.h"
#include "direction_chi_square.h"

using namespace diptych::core::shared;
using namespace diptych::core::tests;

TEST_CASE("Normal reflectance follows the index of refraction") {
    CHECK(close(dielectric_f0(1.5f), 0.04, 1e-5));
    CHECK(dielectric_f0(1.0f) == 0.0f);
    CHECK(dielectric_f0(0.0f) == 1.0f);
    CHECK(close(dielectric_f0(2.42f), std::pow(1.42 / 3.42, 2), 1e-5));
    CHECK(close(dielectric_f0(1e38f), 1.0, 1e-6));
    CHECK(dielectric_f0(-3.0f) == 1.0f);
}

TEST_CASE("Schlick's reflectance runs from f0 at normal incidence to f90 at grazing") {
    const vec3 f0(0.04f, 0.5f, 0.0f);
    const vec3 f90(1.0f, 0.75f, 0.25f);
    for (int k = 0; k <= 64; ++k) {
        const float c = static_cast<float>(k) / 64.0f;
        const vec3 f = fresnel_schlick(f0, f90, c);
        for (int i = 0; i < 3; ++i) {
            const double expected = f0[i] + (f90[i] - f0[i]) * std::pow(1.0 - static_cast<double>(c), 5.0);
            CHECK(std::abs(f[i] - expected) <= 1e-7);
        }
    }
    CHECK(fresnel_schlick(f0, f90, 1.0f) == f0);
    CHECK(fresnel_schlick(f0, f90, 1.0000002f) == f0);
    CHECK(fresnel_schlick(f0, f90, -0.5f) == f90);
}
