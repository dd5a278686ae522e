// Writing picture files with OpenImageIO. It never opens a file itself: every failed write to the disk is seen, whatever
// the format's library checks.
#pragma once

#include "image/image_library.h"

namespace diptych::core {

void encode_exr(const ExrPicture& picture, ByteSink& sink);
ImageLibrary::Bytes hdr_bytes(const Image& image);
ImageLibrary::Bytes png_bytes(const ByteImage& image, bool srgb);

}  // namespace diptych::core
