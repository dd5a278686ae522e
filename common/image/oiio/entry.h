// The one function that libdiptych_images.so exports.
#pragma once

#include "image/image_library.h"

namespace diptych::core {

inline constexpr const char* image_library_entry = "diptych_image_library";

/// Null where the caller is of another version of Diptych, because its classes may have another layout.
using ImageLibraryEntry = const ImageLibrary*(const char* version);

}  // namespace diptych::core
