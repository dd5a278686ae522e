// Files, URIs and containers of glTF, down to plain bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::core::gltf {

/// Reads a whole file. Throws Error (its message without the file's name) where it is missing, no regular file (a
/// device may never end) or unreadable.
std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path);

/// Decodes RFC 4648 base64; white space and missing padding are let through. Nothing where another character stands in
/// it.
std::optional<std::vector<std::uint8_t>> decode_base64(std::string_view text);

/// Turns %20 and its like into bytes; a '%' without two hex digits stays as it is.
std::string decode_percent(std::string_view text);

/// Reads what a buffer's or an image's URI points at: data URIs of any media type, else a file relative to `folder`
/// (escaped or not), which must not lead out of it unless `allow_external`. Throws Error (its message without the
/// file's name).
std::vector<std::uint8_t> read_uri(const std::string& uri, const std::filesystem::path& folder, bool allow_external);

/// The file that such a URI names, escaped or not; nothing where it names none.
std::optional<std::filesystem::path> file_of_uri(const std::string& uri, const std::filesystem::path& folder);

/// The two chunks of a binary glTF.
struct GlbChunks {
    std::string_view json;
    std::optional<std::vector<std::uint8_t>> binary;
};

bool is_glb(const std::vector<std::uint8_t>& bytes);

/// Splits a binary glTF 2.0. `json` looks into `bytes`. Throws Error (its message without the file's name).
GlbChunks split_glb(const std::vector<std::uint8_t>& bytes);

}  // namespace diptych::core::gltf
