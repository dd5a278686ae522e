// Messages of tev's network protocol (github.com/Tom94/tev, README and python/ipc.py): the viewer of this field that
// watches renders grow. A packet is its length in 4 bytes, these included, a byte for its kind, then the fields; all
// little-endian, strings end in a 0.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "image/image.h"

namespace diptych::core::app {

using TevPacket = std::vector<std::uint8_t>;

/// CreateImage (kind 4): an empty picture of that name, shown at once.
TevPacket tev_create_image(const std::string& name, int width, int height);

/// UpdateImage in its third version (kind 6): `rows` rows of `image` from `first_row` down; three channels, linear.
TevPacket tev_update_image(const std::string& name, const Image& image, int first_row, int rows);

}  // namespace diptych::core::app
