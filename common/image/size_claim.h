// The budget for what the header of a file claims.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace diptych {

/// Why a picture of this size is not read from a file of so many bytes; empty where it is. Checked before the picture's
/// memory is taken, so that a few bytes cannot claim gigabytes.
std::string size_claim_problem(std::int64_t width, std::int64_t height, std::int64_t channels, std::size_t file_bytes);

}  // namespace diptych
