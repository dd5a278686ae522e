#include "image/exr_header.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>

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

}  // namespace

std::string exr_header_problem(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (take_number(file) != magic) {
        return "";
    }
    const std::uint64_t size = std::filesystem::file_size(path);
    const std::optional<std::uint32_t> version = take_number(file);
    bool first_of_header = true;
    // Whatever else is wrong with the headers is left to OpenEXR, which says so.
    while (version && file) {
        const std::optional<std::string> name = take_name(file);
        if (!name || (name->empty() && (first_of_header || (*version & several_parts) == 0))) {
            return "";
        }
        first_of_header = name->empty();
        if (first_of_header) {
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
        file.seekg(*bytes, std::ios::cur);
    }
    return "";
}

}  // namespace diptych::core
