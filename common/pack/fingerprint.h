// A name for what is rendered: equal scenes, seen alike, have equal names.
#pragma once

#include <string>

#include "pack/packed_scene.h"

namespace diptych::core {

/// 16 hexadecimal digits, of all arrays, the camera and the environment; of no setting that a picture's metadata tell.
std::string scene_fingerprint(const PackedScene& packed);

}  // namespace diptych::core
