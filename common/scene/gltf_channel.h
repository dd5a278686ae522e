// One channel of a glTF animation, checked.
#pragma once

#include <optional>
#include <string>

#include "scene/animation.h"
#include "scene/gltf_document.h"

namespace diptych::gltf {

/// A channel of `animation`, an object of the file's JSON, its target in the file's indices. Nothing, with a warning,
/// where it moves what cannot be moved. Throws Error in the name of `object` where it is broken.
std::optional<Channel> read_channel(Document& document, const nlohmann::json& animation, const nlohmann::json& channel,
                                    const std::string& object);

}  // namespace diptych::gltf
