// One channel of a glTF animation, checked.
#pragma once

#include <optional>
#include <string>

#include "scene/animation.h"
#include "gltf/document.h"
#include "scene/warnings.h"

namespace diptych::core::gltf {

/// A channel of `animation`, an object of the file's JSON, its target in the file's indices. Faulty keyframes are
/// repaired, with a warning in `warnings`. Nothing, with a warning, where the channel moves what cannot be moved or its
/// keyframes cannot be repaired. Throws Error in the name of `object` where its data cannot be read.
std::optional<Channel> read_channel(Document& document, const nlohmann::json& animation, const nlohmann::json& channel,
                                    const std::string& object, Warnings& warnings);

}  // namespace diptych::core::gltf
