// Writing picture files with OpenImageIO. They are encoded in memory, because then every failed write to the disk is
// seen, whatever the format's library checks.
#pragma once

#include "image/image_library.h"

namespace diptych::core {

ImageLibrary::Bytes hdr_bytes(const Image& image);
ImageLibrary::Bytes png_bytes(const ByteImage& image, bool srgb);

}  // namespace diptych::core
