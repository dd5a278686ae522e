// The format of a picture file, by the bytes that it begins with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace diptych::core {

/// PNG, JPEG, BMP, GIF, WebP, TIFF or OpenEXR, by OpenImageIO's name in lower case; empty for all others.
std::string picture_format(std::span<const std::uint8_t> beginning);

/// Why a file of that format and size is not opened: OpenImageIO's reader of GIF allocates the canvas that the header
/// claims before anybody can look at its size. Empty where there is no such reason.
std::string opening_problem(const std::string& format, std::span<const std::uint8_t> beginning, std::size_t file_bytes);

/// The format of a file; its name's extension, in lower case, where its bytes tell nothing.
std::string picture_format(const std::filesystem::path& path);

/// The bytes that picture_format looks at, or fewer where the file has fewer.
std::vector<std::uint8_t> beginning_of(const std::filesystem::path& path);

}  // namespace diptych::core
