#include <cmath>

#include "catch.h"
#include "image/layered_image.h"
#include "image/tonemap_image.h"
#include "image_fixtures.h"

using namespace diptych::core;
using namespace diptych::core::image_tests;

TEST_CASE("Tone maps have names, and an unknown one lists them", "[image]") {
    for (const char* name : {"none", "exponential", "uncharted2", "aces", "pbr-neutral"}) {
        CHECK(tonemap_name(tonemap_from_name(name)) == std::string(name));
    }
    const std::string message = error_of([] { tonemap_from_name("filmic"); });
    CHECK(contains(message, "'filmic' (known: none, exponential, uncharted2, aces, pbr-neutral)"));
}

TEST_CASE("Without a tone map, display values decode to the exposed radiance", "[image]") {
    const Image linear = random_image(16, 16, 3, 5, 0.0f, 0.25f);
    const Image display = tonemapped(linear, ToneMap::None, 1.5f);
    REQUIRE(display.same_shape(linear));
    for (size_t i = 0; i < linear.data.size(); ++i) {
        CHECK(srgb_decoded(display.data[i]) == Approx(linear.data[i] * std::exp2(1.5f)).epsilon(1e-3).margin(1e-5));
    }
    CHECK_FALSE(error_of([] { tonemapped(make_image(1, 1, 1), ToneMap::None, 0.0f); }).empty());
}

TEST_CASE("The exponential map is 1 - exp(-radiance)", "[image]") {
    const Image display = tonemapped(make_image(1, 1, 3, 0.7f), ToneMap::Exponential, 1.0f);
    CHECK(srgb_decoded(display.data[0]) == Approx(1.0 - std::exp(-1.4)).epsilon(1e-3));
}

TEST_CASE("Every tone map is finite, in 0 to 1 once clamped, and does not darken with radiance", "[image]") {
    for (const ToneMap op :
         {ToneMap::None, ToneMap::Exponential, ToneMap::Uncharted2, ToneMap::Aces, ToneMap::PbrNeutral}) {
        float previous = -1.0f;
        for (float radiance = 0.0f; radiance < 100.0f; radiance = 1.1f * radiance + 0.01f) {
            const float value = tonemapped(make_image(1, 1, 3, radiance), op, 0.0f).data[1];
            const float shown = std::min(value, 1.0f);
            CHECK(std::isfinite(value));
            CHECK(shown >= previous - 1e-5f);
            previous = shown;
        }
        CHECK(previous > 0.75f);
    }
}
