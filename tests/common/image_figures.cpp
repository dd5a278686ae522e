#include <cmath>
#include <limits>

#include "catch.h"
#include "image/figures.h"
#include "image_fixtures.h"

using namespace diptych::core;
using namespace diptych::core::image_tests;

namespace {

double luminance(const Image& image, int x) {
    const auto linear = [&](int channel) { return std::pow(static_cast<double>(image.at(x, 0, channel)), 2.2); };
    return 0.2126 * linear(0) + 0.7152 * linear(1) + 0.0722 * linear(2);
}

}  // namespace

TEST_CASE("The heatmap grows brighter with the value and marks what is not finite", "[image]") {
    Image scalar = make_image(203, 1, 1);
    for (int x = 0; x < 200; ++x) {
        scalar.at(x, 0, 0) = 2.0f + 3.0f * static_cast<float>(x) / 199.0f;
    }
    scalar.at(200, 0, 0) = -100.0f;
    scalar.at(201, 0, 0) = 100.0f;
    scalar.at(202, 0, 0) = std::numeric_limits<float>::quiet_NaN();
    const Image map = heatmap(scalar, 2.0f, 5.0f);
    REQUIRE(map.channels == 3);
    for (int x = 1; x < 200; ++x) {
        CHECK(luminance(map, x) > luminance(map, x - 1));
    }
    for (int channel = 0; channel < 3; ++channel) {
        CHECK(map.at(200, 0, channel) == map.at(0, 0, channel));
        CHECK(map.at(201, 0, channel) == map.at(199, 0, channel));
    }
    CHECK(map.at(0, 0, 0) == Approx(0.001462));
    CHECK(map.at(199, 0, 1) == Approx(0.991438));
    // Entry 128 of 256, between two kept ones.
    const Image middle = heatmap(make_image(1, 1, 1, 128.0f), 0.0f, 255.0f);
    CHECK(middle.at(0, 0, 0) == Approx(0.716387).margin(0.004));
    CHECK(middle.at(0, 0, 1) == Approx(0.214982).margin(0.004));
    CHECK(middle.at(0, 0, 2) == Approx(0.475290).margin(0.004));
    CHECK((map.at(202, 0, 0) == 0.0f && map.at(202, 0, 1) == 1.0f && map.at(202, 0, 2) == 1.0f));
    CHECK_FALSE(error_of([&] { heatmap(map, 0.0f, 1.0f); }).empty());
    CHECK_FALSE(error_of([&] { heatmap(scalar, 1.0f, 1.0f); }).empty());
}

TEST_CASE("The relative difference is the root of the pixel's relative squared error", "[image]") {
    const Image a{2, 1, 3, {1.0f, 2.0f, 3.0f, 0.1f, 0.1f, 0.1f}};
    const Image b{2, 1, 3, {1.0f, 1.0f, 2.0f, 0.0f, 0.0f, std::numeric_limits<float>::infinity()}};
    const Image difference = relative_difference(a, b);
    REQUIRE(difference.channels == 1);
    CHECK(difference.at(0, 0, 0) == Approx(std::sqrt((1.0 / 1.01 + 1.0 / 4.01) / 3.0)));
    CHECK_FALSE(std::isfinite(difference.at(1, 0, 0)));
    CHECK_FALSE(error_of([&] { relative_difference(a, make_image(1, 2, 3)); }).empty());
}

TEST_CASE("Panels stand side by side with a white gap", "[image]") {
    const Image left = random_image(3, 2, 3, 1), middle = random_image(2, 2, 3, 2), right = random_image(4, 2, 3, 3);
    const Image all = side_by_side({left, middle, right}, 2);
    REQUIRE((all.width == 3 + 2 + 2 + 2 + 4 && all.height == 2 && all.channels == 3));
    for (int y = 0; y < 2; ++y) {
        for (int channel = 0; channel < 3; ++channel) {
            CHECK(all.at(2, y, channel) == left.at(2, y, channel));
            CHECK(all.at(3, y, channel) == 1.0f);
            CHECK(all.at(5, y, channel) == middle.at(0, y, channel));
            CHECK(all.at(12, y, channel) == right.at(3, y, channel));
        }
    }
    CHECK_FALSE(error_of([&] { side_by_side({left, make_image(3, 3, 3)}); }).empty());
}
