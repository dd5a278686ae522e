// Reading picture files with OpenImageIO.
#pragma once

#include "image/image_library.h"

namespace diptych::core {

std::unique_ptr<PictureFile> open_picture(const std::string& format, const std::filesystem::path& path);
std::unique_ptr<PictureFile> open_picture(const std::string& format, std::span<const std::uint8_t> bytes);

}  // namespace diptych::core
