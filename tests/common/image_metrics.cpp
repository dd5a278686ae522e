#include <cmath>
#include <limits>
#include <random>

#include "catch.h"
#include "image/metrics.h"
#include "image_fixtures.h"

using namespace diptych::core;
using namespace diptych::core::image_tests;

namespace {

LayeredImage picture(const Image& color) {
    LayeredImage result;
    result.color = color;
    return result;
}

/// Pixels of different spread around `mean`, with the standard error that each was drawn with.
LayeredImage noisy(float mean, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    LayeredImage result;
    result.color = make_image(128, 96, 3);
    result.standard_error = make_image(128, 96, 3);
    for (size_t i = 0; i < result.color.data.size(); ++i) {
        const float spread = 0.05f + 0.1f * static_cast<float>(i % 7);
        result.standard_error->data[i] = spread;
        result.color.data[i] = mean + spread * normal(random);
    }
    return result;
}

}  // namespace

TEST_CASE("Metrics of two pixels match numbers worked out by hand", "[image]") {
    LayeredImage a = picture({2, 1, 3, {1.0f, 2.0f, 3.0f, 0.0f, 0.5f, 4.0f}});
    LayeredImage b = picture({2, 1, 3, {1.0f, 1.0f, 2.0f, 0.0f, 1.0f, 4.0f}});
    a.standard_error = make_image(2, 1, 3, 0.3f);
    b.standard_error = make_image(2, 1, 3, 0.4f);
    const Difference d = compare_images(a, b);
    CHECK(d.mse == Approx((1.0 + 1.0 + 0.25) / 6.0).epsilon(1e-12));
    CHECK(d.relmse == Approx((1.0 / 1.01 + 1.0 / 4.01 + 0.25 / 1.01) / 6.0).epsilon(1e-12));
    CHECK(d.relmse_trimmed == Approx(d.relmse).epsilon(1e-12));
    CHECK(d.trimmed_energy == 0.0);
    CHECK(d.mean_ratio[0] == 1.0);
    CHECK(d.mean_ratio[1] == Approx(1.25).epsilon(1e-12));
    CHECK(d.mean_ratio[2] == Approx(7.0 / 6.0).epsilon(1e-12));
    // Two pixels, each of variance 0.09 + 0.16: the difference of the means has sqrt(0.5) / 2.
    CHECK(d.z_mean[0] == 0.0);
    CHECK(d.z_mean[1] == Approx(0.25 / (std::sqrt(0.5) / 2.0)).epsilon(1e-6));
    CHECK(d.z_mean[2] == Approx(0.5 / (std::sqrt(0.5) / 2.0)).epsilon(1e-6));
    CHECK(d.fraction_equal == 0.0);
    CHECK(d.nonfinite == 0);
}

TEST_CASE("Equal pixels are counted to 1e-3", "[image]") {
    const LayeredImage b = picture(make_image(4, 1, 3, 2.0f));
    LayeredImage a = b;
    a.color.at(1, 0, 2) = 2.0019f;
    a.color.at(2, 0, 0) = 2.0021f;
    CHECK(compare_images(a, b).fraction_equal == 0.75);
    CHECK(compare_images(b, b).fraction_equal == 1.0);
    CHECK(compare_images(b, b).mse == 0.0);
}

TEST_CASE("The trimmed error leaves out one pixel in a thousand and says what it held", "[image]") {
    LayeredImage a = picture(make_image(50, 40, 3, 1.0f));
    const LayeredImage b = a;
    a.color.at(7, 3, 0) = 101.0f;
    a.color.at(8, 9, 1) = 51.0f;
    a.color.at(20, 20, 2) = 2.0f;
    const Difference d = compare_images(a, b);
    const double pixels = 2000.0;
    CHECK(d.relmse == Approx((1e4 + 2500.0 + 1.0) / 1.01 / (3.0 * pixels)).epsilon(1e-10));
    CHECK(d.relmse_trimmed == Approx(1.0 / 1.01 / (3.0 * (pixels - 2.0))).epsilon(1e-10));
    CHECK(d.trimmed_energy == Approx((103.0 + 53.0) / (3.0 * pixels + 100.0 + 50.0 + 1.0)).epsilon(1e-10));
}

TEST_CASE("Pixels that are not finite are counted and left out", "[image]") {
    LayeredImage a = picture(make_image(4, 1, 3, 1.0f));
    LayeredImage b = picture(make_image(4, 1, 3, 2.0f));
    a.color.at(0, 0, 1) = std::numeric_limits<float>::quiet_NaN();
    b.color.at(0, 0, 2) = std::numeric_limits<float>::infinity();
    b.color.at(2, 0, 0) = -std::numeric_limits<float>::infinity();
    const Difference d = compare_images(a, b);
    CHECK(d.nonfinite == 2);
    CHECK(d.mse == 1.0);
    CHECK(d.mean_ratio[0] == 0.5);
    for (float& value : a.color.data) {
        value = std::numeric_limits<float>::quiet_NaN();
    }
    CHECK(compare_images(a, b).nonfinite == 4);
    CHECK(std::isnan(compare_images(a, b).mse));
}

TEST_CASE("z is unknown without standard errors and defined without variance", "[image]") {
    LayeredImage a = picture(make_image(4, 4, 3, 1.0f));
    LayeredImage b = picture(make_image(4, 4, 3, 1.0f));
    a.standard_error = make_image(4, 4, 3, 0.0f);
    CHECK(std::isnan(compare_images(a, b).z_mean[0]));
    b.standard_error = a.standard_error;
    CHECK(compare_images(a, b).z_mean[0] == 0.0);
    b.color.at(0, 0, 0) = 0.5f;
    CHECK(std::isinf(compare_images(a, b).z_mean[0]));
}

TEST_CASE("z tells noise from a shift, and has unit spread", "[image]") {
    double sum = 0.0, sum_of_squares = 0.0;
    const unsigned runs = 40;
    for (unsigned run = 0; run < runs; ++run) {
        const Difference same = compare_images(noisy(1.0f, 2 * run), noisy(1.0f, 2 * run + 1));
        for (const double z : same.z_mean) {
            CHECK(std::abs(z) < 4.0);
            sum += z;
            sum_of_squares += z * z;
        }
    }
    const double count = 3.0 * runs;
    CHECK(std::abs(sum / count) < 4.0 / std::sqrt(count));
    CHECK(std::abs(sum_of_squares / count - 1.0) < 4.0 * std::sqrt(2.0 / count));

    const Difference shifted = compare_images(noisy(1.05f, 1000), noisy(1.0f, 1001));
    for (const double z : shifted.z_mean) {
        CHECK(z > 8.0);
    }
}

TEST_CASE("Pictures of different shape are not compared", "[image]") {
    const LayeredImage a = picture(make_image(4, 3, 3));
    const auto refusal = [&](const LayeredImage& b) { return error_of([&] { compare_images(a, b); }); };
    CHECK(contains(refusal(picture(make_image(4, 2, 3))), "4x3 with 3 channels against 4x2 with 3 channels"));
    CHECK_FALSE(refusal(picture(make_image(4, 3, 1))).empty());
    LayeredImage wrong = a;
    wrong.standard_error = make_image(4, 3, 1);
    CHECK(contains(refusal(wrong), "standard error"));
}
