// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace diptych::core {

/// Writes the bytes to a temporary name beside `path` and renames it over `path`. On failure the file that was
/// at `path` before is untouched, nothing else stays behind, and an Error names the file and the reason.
void write_file_atomically(const std::filesystem::path& path, std::span<const unsigned char> bytes);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

/// Throws an Error unless a file could be created in the folder of `path` now and renamed to `path`.
/// Leaves nothing behind.
void check_file_can_be_created(const std::filesystem::path& path);

}  // namespace diptych::core
