// Files beside and behind a glTF document. For gltf/write.cpp.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace diptych::core::gltf {

/// A name fit for a file: letters, digits, - and _; everything else becomes -.
std::string file_part(std::string name);

/// A relative reference (RFC 3986): everything outside the unreserved characters as %XX.
std::string encoded_uri(const std::string& name);

/// The pieces in one file, which appears whole or not at all. Throws Error where it cannot be written.
void write_whole(const std::filesystem::path& path, std::initializer_list<std::string_view> pieces);

}  // namespace diptych::core::gltf
