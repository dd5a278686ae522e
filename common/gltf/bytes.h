// Files, URIs and containers of glTF, down to plain bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "memory_budget.h"

namespace diptych::core::gltf {

/// Decodes RFC 4648 base64; white space and missing padding are let through. Nothing where another character stands in
/// it.
std::optional<std::vector<std::uint8_t>> decode_base64(std::string_view text);

/// Turns %20 and its like into bytes; a '%' without two hex digits stays as it is.
std::string decode_percent(std::string_view text);

/// A URI names what is never read, or not without leave. Other errors of a URI matter only to those who need the bytes.
class RefusedUri : public Error {
public:
    using Error::Error;
};

/// What a URI may name.
struct UriRules {
    std::filesystem::path folder;  // where relative URIs begin
    bool allow_external;           // they may lead out of it
    MemoryBudget& budget;
};

/// Reads what a buffer's or an image's URI points at: data URIs of any media type, else a file (its name escaped or
/// not). Throws Error (its message without the file's name); RefusedUri where the file lies outside the folder or is a
/// folder, a device or a pipe; and OverBudget.
std::vector<std::uint8_t> read_uri(const std::string& uri, const UriRules& rules);

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
