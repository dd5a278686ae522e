// What libdiptych_images.so exports.
#pragma once

#include "image/image_library.h"

namespace diptych::core {

/// Text by which a program knows that the library was built with the same interface as itself. Otherwise classes may
/// have another layout, and no function may be called.
inline constexpr const char* image_library_interface = "diptych_image_interface";

inline constexpr const char* image_library_entry = "diptych_image_library";
using ImageLibraryEntry = const ImageLibrary*();

}  // namespace diptych::core
