// The format of a picture file, by the bytes that it begins with.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace diptych::core {

/// PNG, JPEG, BMP, GIF, WebP, TIFF or OpenEXR, by OpenImageIO's name in lower case; empty for all others.
std::string picture_format(std::span<const std::uint8_t> beginning);

/// The same for a file; its name's extension, in lower case, where its bytes tell nothing.
std::string picture_format(const std::filesystem::path& path);

}  // namespace diptych::core
