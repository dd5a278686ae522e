// The largest errors of the elementary functions over every float of an interval, as a table.
#include "numbers/elementary.h"

#include "catch.h"
#include "known_values.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

using namespace diptych::core::shared;
using namespace diptych::core::tests;

namespace {

struct Row {
    const char* name;
    float low;
    float high;
    double bound;
    bool absolute;  // the bound is no number of ulps
    float (*approximate)(float);
    double (*exact)(double);
};

const Row rows[] = {
    {"sin_cos, sine", -7, 7, 1.6, false, sine, [](double x) { return std::sin(x); }},
    {"sin_cos, cosine", -7, 7, 1.6, false, cosine, [](double x) { return std::cos(x); }},
    {"sin_cos, sine", -16384, 16384, 3e-7, true, sine, [](double x) { return std::sin(x); }},
    {"sin_cos, cosine", -16384, 16384, 3e-7, true, cosine, [](double x) { return std::cos(x); }},
    {"arctan2(y, 1)", -3e38F, 3e38F, 2.6, false, [](float y) { return arctan2(y, 1.0F); },
     [](double y) { return std::atan2(y, 1.0); }},
    {"arctan2(y, -1)", -3e38F, 3e38F, 2.6, false, [](float y) { return arctan2(y, -1.0F); },
     [](double y) { return std::atan2(y, -1.0); }},
    {"arccos", -1, 1, 3.4, false, arccos, [](double x) { return std::acos(x); }},
    {"exp2_poly", -126, 127.99999F, 1.6, false, exp2_poly, [](double x) { return std::exp2(x); }},
    {"log2_poly", 1.17549435e-38F, 3.4e38F, 1.8, false, log2_poly, [](double x) { return std::log2(x); }},
    {"log1p_poly", -0.99999994F, 1e30F, 3.5, false, log1p_poly, [](double x) { return std::log1p(x); }},
};

double error_at(const Row& row, float x) {
    const double truth = row.exact(double(x));
    const double error = std::abs(double(row.approximate(x)) - truth);
    if (!std::isfinite(error)) {
        return INFINITY;
    }
    const double size = std::max(std::abs(truth), 0x1p-126);
    return row.absolute ? error : error / std::ldexp(1.0, std::ilogb(size) - 23);
}

/// Over every `stride`-th normal float and 0.
double largest_error(const Row& row, uint stride) {
    const unsigned threads = std::max(1U, std::thread::hardware_concurrency());
    std::vector<double> worst(threads, error_at(row, row.low <= 0 ? 0.0F : row.low));
    std::vector<std::thread> pool;
    for (unsigned t = 0; t < threads; ++t) {
        pool.emplace_back([&, t] {
            for (uint bits = 0x00800000U + t * stride; bits < 0x7f800000U; bits += threads * stride) {
                for (const float x : {uintBitsToFloat(bits), -uintBitsToFloat(bits)}) {
                    if (x >= row.low && x <= row.high) {
                        worst[t] = std::max(worst[t], error_at(row, x));
                    }
                }
            }
        });
    }
    for (std::thread& thread : pool) {
        thread.join();
    }
    return *std::max_element(worst.begin(), worst.end());
}

void check_rows(uint stride, bool print) {
    for (const Row& row : rows) {
        const double worst = largest_error(row, stride);
        CAPTURE(row.name, row.low, row.high);
        CHECK(worst <= row.bound);
        if (print) {
            std::printf("| %s | %g to %g | %g %s | %.3g |\n", row.name, double(row.low), double(row.high), row.bound,
                        row.absolute ? "absolute" : "ulp", worst);
        }
    }
}

}  // namespace

TEST_CASE("Elementary functions keep their bounds over one float in 4099") {
    check_rows(4099, std::getenv("DIPTYCH_TABLE") != nullptr);
}

TEST_CASE("Elementary functions keep their bounds over every float", "[nightly]") {
    check_rows(1, true);
}
