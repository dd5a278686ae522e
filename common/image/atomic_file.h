// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

#include "image/temporary_file.h"

namespace diptych::core {

/// Writes the bytes to a temporary name beside `path`, waits until the disk holds them, and renames the file over
/// `path`. On failure the file that was at `path` before is untouched, nothing else stays behind, and an Error names the
/// file and the reason.
void write_file_atomically(const std::filesystem::path& path, std::span<const unsigned char> bytes);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

/// Files that belong together, such as a .gltf and its .bin. They take their names only when all of them have been
/// written, so a disk that fills up leaves all old files in place.
class FilesTogether {
public:
    /// Writes the pieces, one after the other, as the file `path`, under a temporary name. Throws Error.
    void add(const std::filesystem::path& path, std::initializer_list<std::string_view> pieces);
    /// Renames all, in the order in which they were added. Throws Error.
    void publish();

private:
    std::vector<TemporaryFile> files_;
};

/// Throws an Error unless a file could be created in the folder of `path` now and renamed to `path`.
/// Leaves nothing behind.
void check_file_can_be_created(const std::filesystem::path& path);

}  // namespace diptych::core
