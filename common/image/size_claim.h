// The budget for what the header of a file claims.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace diptych::core {

/// Bytes of floats that any file may claim: for pixels that it stores, and for a display window, which may be large and
/// nearly empty.
inline constexpr double stored_grant = 1 << 26;
inline constexpr double display_grant = 1 << 30;

/// Why a picture of this size is not read from a file of so many bytes; empty where it is. Beyond the grant, a picture
/// must be in proportion to its file. Checked before the picture's memory is taken, so that a few bytes cannot claim
/// gigabytes.
std::string size_claim_problem(std::int64_t width, std::int64_t height, std::int64_t channels, std::size_t file_bytes,
                               double grant = stored_grant);

/// Bytes of so many floats.
std::uint64_t float_bytes(std::int64_t width, std::int64_t height, std::int64_t channels);

}  // namespace diptych::core
