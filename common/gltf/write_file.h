// Names of files beside a glTF document. For gltf/write.cpp.
#pragma once

#include <string>

namespace diptych::core::gltf {

/// A name fit for a file: letters, digits, - and _; everything else becomes -.
std::string file_part(std::string name);

/// A relative reference (RFC 3986): everything outside the unreserved characters as %XX.
std::string encoded_uri(const std::string& name);

}  // namespace diptych::core::gltf
