// Sums of doubles that do not depend on the order of their terms: digits to base 2^32, a 64-bit bin for each.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace diptych::core::oracle {

/// Sums x^power over vectors of numbers x >= 0. Bin k sums digit base + k, whose weight is 2^(32 (base + k) + unit). The
/// window of `bins` digits follows the largest term of any channel; lower digits are left out. Holds 2^32 terms.
template <int channels, int bins, int power = 1>
struct ExactSum {
    static constexpr int unit = power * (-149 - 32 * 32);  // below the smallest float

    std::array<std::array<std::uint64_t, bins>, channels> sums{};
    int base = 0;

    void add(const std::array<double, channels>& x) {
        std::array<Term, channels> terms;
        std::transform(x.begin(), x.end(), terms.begin(), term_of);
        raise_base((term_of(*std::max_element(x.begin(), x.end())).position + 53 * power - 1) / 32 - (bins - 1));
        for (int channel = 0; channel < channels; ++channel) {
            for (int k = 0; k < bins; ++k) {
                sums[channel][k] += digit_of(terms[channel], base + k);
            }
        }
    }

    long double value(int channel) const {
        long double value = 0;
        for (int k = 0; k < bins; ++k) {
            value += std::ldexp(static_cast<long double>(sums[channel][k]), 32 * (base + k) + unit);
        }
        return value;
    }

private:
    __extension__ using Wide = unsigned __int128;

    /// mantissa 2^(position + unit)
    struct Term {
        Wide mantissa = 0;
        int position = 0;
    };

    static Term term_of(double x) {
        int exponent = 0;
        const double fraction = std::frexp(x, &exponent);
        const Wide mantissa = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
        const Term term{power == 2 ? mantissa * mantissa : mantissa, power * (exponent - 53) - unit};
        return term.position >= 0 ? term : Term{};  // below the last digit
    }

    static std::uint64_t digit_of(const Term& term, int digit) {
        const int right = 32 * digit - term.position;
        if (right >= 128 || right <= -32) {
            return 0;
        }
        return static_cast<std::uint32_t>(right >= 0 ? term.mantissa >> right : term.mantissa << -right);
    }

    void raise_base(int least) {
        for (; base < least; ++base) {
            for (std::array<std::uint64_t, bins>& channel : sums) {
                std::rotate(channel.begin(), channel.begin() + 1, channel.end());
                channel.back() = 0;
            }
        }
    }
};

}  // namespace diptych::core::oracle
