#include "image/exr_header.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string_view>

#include "image/size_claim.h"

namespace diptych::core {
namespace {

// OpenEXR, "Technical Introduction": magic number and version, then headers of attributes, each a name and a type, both
// of which end in a zero byte, a size of four bytes, and the value. An empty name ends a header; an empty header ends
// those of a file of several parts.
constexpr std::uint32_t magic = 20000630;
constexpr std::uint32_t several_parts = 0x1000;
constexpr std::size_t longest_name = 255;

std::optional<std::uint32_t> take_number(std::ifstream& file) {
    std::array<unsigned char, 4> b{};
    if (!file.read(reinterpret_cast<char*>(b.data()), b.size())) {
        return std::nullopt;
    }
    return std::uint32_t{b[0]} | std::uint32_t{b[1]} << 8U | std::uint32_t{b[2]} << 16U | std::uint32_t{b[3]} << 24U;
}

std::optional<std::string> take_name(std::ifstream& file) {
    std::string name;
    for (char c = 0; name.size() <= longest_name && file.get(c);) {
        if (c == 0) {
            return name;
        }
        name += c;
    }
    return std::nullopt;
}

struct FixedType {
    std::string_view name;
    std::uint32_t bytes;
};

constexpr std::array<FixedType, 24> fixed_types = {
    {{"box2i", 16},     {"box2f", 16},   {"chromaticities", 32}, {"compression", 1}, {"deepImageState", 1},
     {"double", 8},     {"envmap", 1},   {"float", 4},           {"int", 4},         {"keycode", 28},
     {"lineOrder", 1},  {"m33f", 36},    {"m33d", 72},           {"m44f", 64},       {"m44d", 128},
     {"rational", 8},   {"tiledesc", 9}, {"timecode", 8},        {"v2i", 8},         {"v2f", 8},
     {"v2d", 16},       {"v3i", 12},     {"v3f", 12},            {"v3d", 24}}};

/// What the pixels of a part claim. OpenEXR allocates a block of rows of all channels when it opens the part.
struct Claim {
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::int64_t channels = 0;
    std::int64_t block_rows = 1;

    /// Empty where a file of that size may hold them.
    std::string problem(std::uint64_t file_bytes) const {
        const bool complete = width != 0 && channels != 0;
        return complete ? size_claim_problem(width, std::max(height, block_rows), channels, file_bytes) : "";
    }
};

/// Rows of a block, by the number of the compression: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB.
constexpr std::array<std::int64_t, 10> rows_of_compression = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};

/// Bytes of a list of channels, to the empty name that ends it: each is a name and 16 bytes.
std::optional<std::uint64_t> channel_list_bytes(std::ifstream& file, Claim& claim) {
    constexpr std::uint64_t after_name = 16;
    std::uint64_t bytes = 0;
    while (const std::optional<std::string> name = take_name(file)) {
        bytes += name->size() + 1;
        if (name->empty()) {
            return bytes;
        }
        ++claim.channels;
        bytes += after_name;
        file.seekg(after_name, std::ios::cur);
    }
    return std::nullopt;
}

/// The corners of a box, both within it.
void read_window(std::ifstream& file, Claim& claim) {
    std::array<std::int64_t, 4> corners{};
    for (std::int64_t& corner : corners) {
        corner = static_cast<std::int32_t>(take_number(file).value_or(0));
    }
    claim.width = corners[2] - corners[0] + 1;
    claim.height = corners[3] - corners[1] + 1;
}

/// Bytes of the strings, each after its length, that begin within the first `limit` bytes.
std::optional<std::uint64_t> string_list_bytes(std::ifstream& file, std::uint64_t limit) {
    std::uint64_t bytes = 0;
    while (bytes < limit) {
        const std::optional<std::uint32_t> length = take_number(file);
        if (!length) {
            return std::nullopt;
        }
        bytes += 4 + std::uint64_t{*length};
        file.seekg(*length, std::ios::cur);
    }
    return bytes;
}

/// A size of two numbers, then four bytes a pixel.
std::optional<std::uint64_t> preview_bytes(std::ifstream& file) {
    const std::optional<std::uint32_t> width = take_number(file);
    const std::optional<std::uint32_t> height = width ? take_number(file) : std::nullopt;
    constexpr std::uint32_t most = 1U << 20U;
    if (!height || *width > most || *height > most) {
        return std::nullopt;
    }
    return 8 + std::uint64_t{4} * *width * *height;
}

/// Whether a value of this type, which begins here, has that many bytes. OpenEXR reads some types by their contents,
/// and goes on after them, not after the bytes that the attribute claims.
bool is_size_of(std::string_view type, std::uint32_t bytes, std::ifstream& file, Claim& claim) {
    const auto fixed = std::find_if(fixed_types.begin(), fixed_types.end(),
                                    [&](const FixedType& known) { return known.name == type; });
    if (fixed != fixed_types.end()) {
        return bytes == fixed->bytes;
    }
    if (type == "chlist") {
        return channel_list_bytes(file, claim) == bytes;
    }
    if (type == "stringvector") {
        return string_list_bytes(file, bytes) == bytes;
    }
    return type != "preview" || preview_bytes(file) == bytes;
}

}  // namespace

std::string exr_header_problem(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (take_number(file) != magic) {
        return "";
    }
    const std::uint64_t size = std::filesystem::file_size(path);
    const std::optional<std::uint32_t> version = take_number(file);
    bool first_of_header = true;
    Claim claim;
    // Whatever else is wrong with the headers is left to OpenEXR, which says so.
    while (version && file) {
        const std::optional<std::string> name = take_name(file);
        if (!name || (name->empty() && (first_of_header || (*version & several_parts) == 0))) {
            return "";
        }
        first_of_header = name->empty();
        if (first_of_header) {
            claim = {};
            continue;
        }
        const std::optional<std::string> type = take_name(file);
        const std::optional<std::uint32_t> bytes = type ? take_number(file) : std::nullopt;
        if (!bytes) {
            return "";
        }
        const auto at = static_cast<std::uint64_t>(file.tellg());
        if (*bytes > size - at) {
            return "its attribute '" + *name + "' claims " + std::to_string(*bytes) + " bytes, more than the file has";
        }
        if (!is_size_of(*type, *bytes, file, claim)) {
            return "its attribute '" + *name + "' of type '" + *type + "' does not have the " +
                   std::to_string(*bytes) + " bytes that it claims";
        }
        file.clear();
        file.seekg(static_cast<std::streamoff>(at));
        if (*name == "dataWindow") {
            read_window(file, claim);
        } else if (*name == "compression") {
            const auto kind = static_cast<std::size_t>(file.get());
            claim.block_rows = kind < rows_of_compression.size() ? rows_of_compression[kind] : 1;
        }
        if (const std::string problem = claim.problem(size); !problem.empty()) {
            return problem;
        }
        file.seekg(static_cast<std::streamoff>(at + *bytes));
    }
    return "";
}

}  // namespace diptych::core
