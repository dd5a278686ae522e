#include "image/size_claim.h"

namespace diptych::core {
namespace {

constexpr std::int64_t most_pixels = std::int64_t{1} << 28;  // 16384 x 16384
constexpr std::int64_t longest_side = 1 << 17;               // decoders keep many rows at a time
// No format that is read packs floats closer: deflate reaches 1032 to 1, DWA over it 64 times as much, in half floats.
constexpr double most_packed = 1 << 17;

}  // namespace

std::string size_claim_problem(std::int64_t width, std::int64_t height, std::int64_t channels, std::size_t file_bytes,
                               double grant) {
    const std::string size = std::to_string(width) + "x" + std::to_string(height) + " pixels";
    if (width < 1 || height < 1 || channels < 1) {
        return "it holds no pixels (" + size + ")";
    }
    if (width > longest_side || height > longest_side || width * height > most_pixels) {
        return size + " are more than Diptych reads (" + std::to_string(longest_side) + " a side, " +
               std::to_string(most_pixels) + " in all)";
    }
    const double bytes = 4.0 * static_cast<double>(width * height) * static_cast<double>(channels);
    if (bytes > grant && bytes > most_packed * static_cast<double>(file_bytes)) {
        return "a file of " + std::to_string(file_bytes) + " bytes cannot hold the " + size + " that its header claims";
    }
    return "";
}

std::uint64_t float_bytes(std::int64_t width, std::int64_t height, std::int64_t channels) {
    return sizeof(float) * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) *
           static_cast<std::uint64_t>(channels);
}

}  // namespace diptych::core
