// Radiance pictures (.hdr) as linear Rec.709. OpenImageIO reads their bytes, but neither turns a picture as its
// resolution line says, nor divides by EXPOSURE, nor knows XYZE, nor the older run lengths.
#pragma once

#include <filesystem>
#include <string_view>

#include "image/image.h"
#include "memory_budget.h"

namespace diptych::core {

/// Whether a file's first bytes are those of a Radiance picture.
bool is_radiance(std::string_view first_bytes);

/// Three channels of radiance, upright, in Rec.709. RGB without PRIMARIES is taken for Rec.709; XYZ is converted without
/// adaptation. Throws a std::runtime_error with the reason, without the file's name; a file too short for its resolution
/// is refused before the picture's memory is taken, and so is what the budget does not allow.
Image read_radiance(const std::filesystem::path& path, MemoryBudget& budget);

}  // namespace diptych::core
