// A picture file of one format: loads, or is refused in one line.
#pragma once

#include "image/layered_image.h"
#include "target.h"

namespace diptych::core::fuzz {

inline int read_picture(const InputFile& file, std::span<const std::uint8_t> bytes) {
    const auto& path = file.write(bytes);
    must_load_or_refuse(path, [&] { read_image(path, "", memory_limit); });
    return 0;
}

}  // namespace diptych::core::fuzz
