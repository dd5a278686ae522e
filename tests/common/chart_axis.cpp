#include <cmath>
#include <limits>

#include "catch.h"
#include "chart/axis.h"
#include "chart/number_text.h"

using namespace diptych::core::chart;

namespace {

/// The labels of the ticks; "|" for one without.
std::string labels_of(const std::vector<Tick>& ticks) {
    std::string labels;
    for (const Tick& tick : ticks) {
        labels += (labels.empty() ? "" : " ") + (tick.text.empty() ? std::string("|") : tick.text);
    }
    return labels;
}

}  // namespace

TEST_CASE("An axis has ticks at round values within its range", "[chart]") {
    struct Expected {
        Scale scale;
        Range range;
        int most;
        TickText text;
        const char* labels;
    };
    const TickText number = TickText::number;
    const TickText seconds = TickText::seconds;
    for (const Expected& e : {
             Expected{Scale::linear, {0, 1}, 6, number, "0 0.2 0.4 0.6 0.8 1"},
             Expected{Scale::linear, {0, 1}, 12, number, "0 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 1"},
             Expected{Scale::linear, {-3, 7.5}, 6, number, "-2 0 2 4 6"},
             Expected{Scale::linear, {1000001, 1000004}, 4, number, "1.000001·10⁶ 1.000002·10⁶ 1.000003·10⁶ 1.000004·10⁶"},
             Expected{Scale::linear, {0, 3e-7}, 4, number, "0 10⁻⁷ 2·10⁻⁷ 3·10⁻⁷"},
             // One, two and five, while all of them have room; else the decades; else every other decade.
             Expected{Scale::decimal, {0.9, 12}, 6, number, "1 2 5 10"},
             Expected{Scale::decimal, {0.01, 10}, 10, number, "0.01 0.02 0.05 0.1 0.2 0.5 1 2 5 10"},
             Expected{Scale::decimal, {0.01, 10}, 9, number, "0.01 | | 0.1 | | 1 | | 10"},
             Expected{Scale::decimal, {0.7, 1.2e4}, 3, number, "1 | | | | | 100 | | | | | 10000"},
             Expected{Scale::decimal, {1e-5, 1e-3}, 3, number, "10⁻⁵ | | 10⁻⁴ | | 10⁻³"},
             Expected{Scale::decimal, {8e-5, 0.3}, 20, number,
                      "10⁻⁴ 2·10⁻⁴ 5·10⁻⁴ 10⁻³ 2·10⁻³ 5·10⁻³ 10⁻² 2·10⁻² 5·10⁻² 10⁻¹ 2·10⁻¹"},
             // Less than one step of one, two and five.
             Expected{Scale::decimal, {3.1, 4.6}, 4, number, "3.5 4 4.5"},
             Expected{Scale::decimal, {5e-4, 2}, 12, seconds, "500 µs 1 ms 2 ms 5 ms 10 ms 20 ms 50 ms 100 ms 200 ms 500 ms 1 s 2 s"},
             Expected{Scale::binary, {1, 64}, 8, number, "1 2 4 8 16 32 64"},
             Expected{Scale::binary, {0.8, 1200}, 6, number, "1 | 4 | 16 | 64 | 256 | 1024"},
             Expected{Scale::binary, {8192, 4e6}, 12, number, "8192 16 Ki 32 Ki 64 Ki 128 Ki 256 Ki 512 Ki 1 Mi 2 Mi"},
         }) {
        INFO(e.range.low << " to " << e.range.high << ", at most " << e.most);
        CHECK(labels_of(axis_ticks(e.scale, e.range, e.most, e.text)) == e.labels);
    }
}

TEST_CASE("No axis has more labels than are asked for, nor ticks beyond its range", "[chart]") {
    for (const Scale scale : {Scale::linear, Scale::decimal, Scale::binary}) {
        for (double low = 1e-12; low < 1e9; low *= 17.3) {
            for (double ratio = 1.01; ratio < 1e25; ratio = ratio < 3 ? ratio * 1.3 : ratio * 97) {
                for (const int most : {2, 3, 7, 14}) {
                    const Range range{low, low * ratio};
                    INFO(low << " to " << low * ratio << ", at most " << most);
                    int labels = 0;
                    double last = -1;
                    const double slack = 1e-6 * (range.high - range.low);
                    for (const Tick& tick : axis_ticks(scale, range, most)) {
                        labels += tick.text.empty() ? 0 : 1;
                        CHECK(tick.value > last);
                        CHECK(tick.value <= range.high + slack);
                        CHECK(tick.value >= range.low - slack);
                        last = tick.value;
                    }
                    CHECK(labels <= most);
                    CHECK(labels >= 1);
                }
            }
        }
    }
}

TEST_CASE("A value lies on its axis in proportion, or by its logarithm", "[chart]") {
    CHECK(share_of(Scale::linear, {2, 6}, 3) == Approx(0.25));
    CHECK(share_of(Scale::linear, {-1, 1}, -5) == 0);
    CHECK(share_of(Scale::linear, {-1, 1}, 5) == 1);
    CHECK(share_of(Scale::decimal, {1e-4, 1e4}, 100) == Approx(0.75));
    CHECK(share_of(Scale::binary, {1, 16}, 2) == Approx(0.25));
    CHECK(share_of(Scale::decimal, {1e-4, 1e4}, 0) == 0);
    CHECK(share_of(Scale::decimal, {1e-4, 1e4}, -3) == 0);
    const double infinity = std::numeric_limits<double>::infinity();
    for (const Scale scale : {Scale::linear, Scale::decimal, Scale::binary}) {
        CHECK(can_show(scale, 0.5));
        CHECK(can_show(scale, 0) == (scale == Scale::linear));
        CHECK(can_show(scale, -1) == (scale == Scale::linear));
        CHECK_FALSE(can_show(scale, infinity));
        CHECK_FALSE(can_show(scale, std::nan("")));
    }
}

TEST_CASE("Charts write numbers in three digits, with a unit or a power of ten", "[chart]") {
    CHECK(figure_text(0) == "0");
    CHECK(figure_text(0.0123456) == "0.0123");
    CHECK(figure_text(-1.5) == "-1.5");
    CHECK(figure_text(999.96) == "1000");
    CHECK(figure_text(12345) == "12345");
    CHECK(figure_text(4.1234e-5) == "4.12·10⁻⁵");
    CHECK(figure_text(-9.9999e-5) == "-10⁻⁴");
    CHECK(figure_text(1e12) == "10¹²");
    CHECK(figure_text(std::nan("")) == "–");
    CHECK(seconds_text(1234.4) == "1234 s");
    CHECK(seconds_text(1.5) == "1.5 s");
    CHECK(seconds_text(0.02) == "20 ms");
    CHECK(seconds_text(0.9999) == "1000 ms");
    CHECK(seconds_text(5e-6) == "5 µs");
    CHECK(seconds_text(3e-8) == "30 ns");
    CHECK(binary_text(8192) == "8192");
    CHECK(binary_text(1 << 16) == "64 Ki");
    CHECK(binary_text(3 << 20) == "3 Mi");
    CHECK(power_text(10) == "10");
    CHECK(power_text(1) == "1");
    CHECK(plain_text(3 * 0.1) == "0.3");
    CHECK(plain_text(-0.0) == "0");
}
