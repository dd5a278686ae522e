// Numbers as charts write them.
#pragma once

#include <string>

namespace diptych::core::chart {

/// Whether a number reads well without a power of ten: 0, and from 0.001 to below 100000.
bool is_plain_number(double value);

/// "0.05", without needless zeros.
std::string plain_text(double value);

/// "10⁻⁵", "2·10⁻⁵", "1", "10", with as many digits as it takes, up to the given number.
std::string power_text(double value, int digits = 12);

/// A measured number in three digits: "0.0123", "1.23·10⁻⁵"; "–" where it is not finite.
std::string figure_text(double value);

/// "120 s", "1.5 s", "20 ms", "5 µs", in three digits; "–" where it is not finite.
std::string seconds_text(double seconds);

/// "512", "16 Ki", "2 Mi": in units of 1024 from 16384 on.
std::string binary_text(double value);

}  // namespace diptych::core::chart
