// Special functions and distributions against values computed with mpmath 1.3 at 40 digits.
#include <cmath>

#include "catch.h"
#include "stats/distributions.h"
#include "stats/kolmogorov_smirnov.h"
#include "stats/power.h"
#include "stats/special_functions.h"

using namespace diptych::core;

namespace {

/// Relative error.
double error_of(double value, double truth) {
    return std::abs(value - truth) / std::abs(truth);
}

}  // namespace

TEST_CASE("The incomplete gamma functions have their values in both tails") {
    struct Row {
        double a, x, lower, upper;
    };
    for (const Row& row : {
             Row{0.5, 0.1, 0.34527915398142298, 0.65472084601857702},
             Row{0.5, 3, 0.98569412156457036, 0.01430587843542964},
             Row{1, 1, 0.63212055882855768, 0.36787944117144232},
             Row{2.5, 2.5, 0.58411981300449208, 0.41588018699550792},
             Row{10, 3, 0.0011024881301154797, 0.99889751186988452},
             Row{10, 30, 0.99999287824913718, 7.1217508628155771e-6},
             Row{100, 90, 0.15822098918643017, 0.84177901081356983},
             Row{1000, 1100, 0.99894067674607002, 0.0010593232539299773},
             Row{5000, 5200, 0.99741518650464619, 0.0025848134953538087},
             Row{0.5, 300, 1.0, 1.6741679846917878e-132},
         }) {
        CAPTURE(row.a, row.x);
        const double bound = 1e-13 * std::max(1.0, row.a);  // exp(a log x - x - lgamma a) loses digits with a
        CHECK(error_of(regularized_gamma_lower(row.a, row.x), row.lower) < bound);
        CHECK(error_of(regularized_gamma_upper(row.a, row.x), row.upper) < bound);
    }
    CHECK(regularized_gamma_lower(3, 0) == 0);
    CHECK(regularized_gamma_upper(3, INFINITY) == 0);
}

TEST_CASE("The incomplete beta function has its values down to tiny ones") {
    struct Row {
        double a, b, x, value;
    };
    for (const Row& row : {
             Row{0.5, 0.5, 0.25, 0.33333333333333333},
             Row{2, 3, 0.4, 0.52480000000000004},
             Row{31, 0.5, 0.9, 0.010907361289023446},
             Row{31, 0.5, 0.01, 1.0141611972152086e-63},
             Row{15.5, 1.5, 0.3, 3.0295200770735672e-8},
             Row{200, 300, 0.4, 0.502428616319932},
             Row{1000, 0.5, 0.999, 0.15724727426672383},
             Row{0.5, 31, 0.2, 0.99978847755143112},
             Row{30, 1.5, 0.05, 5.6847967240318745e-39},
         }) {
        CAPTURE(row.a, row.b, row.x);
        CHECK(error_of(regularized_beta(row.a, row.b, row.x), row.value) < 1e-14 * std::max(100.0, row.a + row.b));
    }
    CHECK(regularized_beta(2, 3, 0) == 0);
    CHECK(regularized_beta(2, 3, 1) == 1);
}

TEST_CASE("Student's, Fisher's and the chi-square distribution have their tails") {
    CHECK(error_of(student_two_sided(1, 1), 0.5) < 1e-13);
    CHECK(error_of(student_two_sided(-2, 5), 0.10193947882985836) < 1e-13);
    CHECK(error_of(student_two_sided(2.5, 31), 0.01792022681338622) < 1e-13);
    CHECK(error_of(student_two_sided(3.3, 62), 0.0016057273460695209) < 1e-12);
    CHECK(error_of(student_two_sided(6, 40.7), 4.4415090683065727e-7) < 1e-12);
    CHECK(error_of(student_two_sided(12, 31), 3.4779268004197404e-13) < 1e-12);
    CHECK(error_of(student_two_sided(0.01, 10), 0.99221797499097142) < 1e-13);
    CHECK(error_of(student_two_sided(40, 3), 3.4380680789158528e-5) < 1e-12);
    CHECK(student_cdf(-2, 5) == Approx(0.10193947882985836 / 2));
    CHECK(student_cdf(2, 5) == Approx(1 - 0.10193947882985836 / 2));
    CHECK(error_of(f_upper(1, 1, 1), 0.5) < 1e-13);
    CHECK(error_of(f_upper(3, 3, 60), 0.037498962534297832) < 1e-12);
    CHECK(error_of(f_upper(10, 3, 59.5), 1.9760603887896343e-5) < 1e-12);
    CHECK(error_of(f_upper(0.2, 2, 40), 0.81954447033729557) < 1e-12);
    CHECK(error_of(f_upper(40, 3, 31), 8.9812191336102063e-11) < 1e-12);
    CHECK(error_of(f_upper(2.5, 7, 11), 0.084358961076395085) < 1e-12);
    CHECK(error_of(f_upper(6.25, 1, 31), student_two_sided(2.5, 31)) < 1e-12);  // t² is F(1, n)
    CHECK(error_of(chi_square_upper(3.84, 1), 0.050043521248705103) < 1e-12);
    CHECK(error_of(chi_square_upper(10, 10), 0.44049328506521241) < 1e-12);
    CHECK(error_of(chi_square_upper(60, 30), 0.00092068239614866626) < 1e-12);
    CHECK(error_of(chi_square_upper(2200, 2000), 0.0010593232539299773) < 1e-10);
    CHECK(std::isnan(student_two_sided(NAN, 5)));
    CHECK(std::isnan(f_upper(NAN, 1, 5)));
    CHECK(student_two_sided(INFINITY, 5) == 0);
}

TEST_CASE("Quantiles undo their distribution functions") {
    CHECK(error_of(normal_quantile(0.975), 1.9599639845400542) < 1e-14);
    CHECK(error_of(normal_quantile(0.9995), 3.2905267314918948) < 1e-13);
    CHECK(error_of(normal_quantile(0.9), 1.2815515655446005) < 1e-14);
    CHECK(error_of(normal_quantile(1e-10), -6.3613409024040562) < 1e-14);
    CHECK(error_of(normal_quantile(0.3), -0.52440051270804078) < 1e-14);
    CHECK(error_of(normal_quantile(1e-300), -37.047096299361199) < 1e-14);
    CHECK(normal_quantile(0.5) == Approx(0).margin(1e-15));
    CHECK(error_of(student_quantile(0.975, 31), 2.0395134463964085) < 1e-12);
    CHECK(error_of(student_quantile(0.975, 62), 1.998971517033379) < 1e-12);
    CHECK(error_of(student_quantile(0.9995, 40.5), 3.5475300139827259) < 1e-11);
    CHECK(error_of(student_quantile(0.1, 5), -1.4758840488244811) < 1e-12);
    CHECK(error_of(student_quantile(0.9999995, 62), 5.4293303985165613) < 1e-9);
    CHECK(error_of(chi_square_quantile(0.95, 1), 3.841458820694126) < 1e-12);
    CHECK(error_of(chi_square_quantile(0.5, 10), 9.3418177655919674) < 1e-12);
    CHECK(error_of(chi_square_quantile(0.999, 200), 267.54052782275719) < 1e-11);
    CHECK(normal_quantile(0) == -INFINITY);
    CHECK(std::isnan(normal_quantile(2)));
}

TEST_CASE("Kolmogorov's distance and its distribution are right") {
    // Four values, by hand: the largest gap is below 0.9, where 0.75 of them lie.
    CHECK(kolmogorov_smirnov_uniform({0.1, 0.9, 0.3, 0.4}).distance == Approx(0.35));
    // Such even values that sqrt(n) D is known: D = 1/(2n), p = 1.
    std::vector<double> even;
    for (int i = 0; i < 1000; ++i) {
        even.push_back((i + 0.5) / 1000);
    }
    CHECK(kolmogorov_smirnov_uniform(even).p == Approx(1));
    // Shifted by d, D is d + 1/(2n): the limit's values at x = 0.5, 0.8, 1.36, 2.
    const double n = 1000;
    const double stretch = std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n);
    for (const auto& [x, p] : {std::pair{0.5, 0.963945243664875},
                               {0.8, 0.544142411574198},
                               {1.36, 0.0494858767553779},
                               {2.0, 0.000670925255779695}}) {
        std::vector<double> shifted = even;
        for (double& value : shifted) {
            value = std::min(1.0, value + x / stretch - 1 / (2 * n));
        }
        CHECK(kolmogorov_smirnov_uniform(shifted).p == Approx(p).epsilon(1e-9));
    }
}

TEST_CASE("The sample size is the one that textbooks give") {
    CHECK(samples_per_side(1e-6, 0.9, 2, 0.01) == Approx(3048662.02282433));
    // What so many samples can see is what was asked of them.
    const double error = 2 * std::sqrt(2 / 3048662.02282433);
    CHECK(minimum_detectable(error, 1e9, 1e-6, 0.9) == Approx(0.01).epsilon(1e-6));
    CHECK(minimum_detectable(0.2, 31, 0.05, 0.9) == Approx(0.2 * (2.0395134463964085 + student_quantile(0.9, 31))));
    CHECK(minimum_detectable(0, 31, 0.05, 0.9) == 0);
}
