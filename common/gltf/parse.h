// The text of a glTF document, parsed.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "gltf/document.h"

namespace diptych::core::gltf {

/// The root object, in time linear in the text. Throws Error where the text is no JSON, nested too deeply, repeats a
/// name in an object, or holds a number beyond double precision; where there is one, it names the JSON pointer.
nlohmann::json parse_json(const Document& document, std::string_view text);

/// A name as a part of a JSON pointer (RFC 6901), with the slash before it.
std::string pointer_part(std::string_view name);

}  // namespace diptych::core::gltf
