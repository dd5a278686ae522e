// The types of a glTF document's members, checked before anything reads them.
#pragma once

#include <nlohmann/json.hpp>

#include "gltf/document.h"

namespace diptych::core::gltf {

/// Throws Error naming the JSON pointer where a member that the import reads has the wrong type or is out of range: a
/// reader would take its default instead, silently. Members may be missing. Whole numbers written as 4.0 become
/// integers.
void check_types(const Document& document, nlohmann::json& root);

}  // namespace diptych::core::gltf
