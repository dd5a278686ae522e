#include "image/picture_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <fstream>
#include <string_view>

#include "image/size_claim.h"

namespace diptych::core {
namespace {

using namespace std::string_view_literals;

struct Magic {
    std::string_view bytes;
    std::string_view format;
};

constexpr std::array<Magic, 7> magics = {{{"\x89PNG"sv, "png"},
                                          {"\xff\xd8\xff"sv, "jpeg"},
                                          {"BM"sv, "bmp"},
                                          {"GIF8"sv, "gif"},
                                          {"II*\0"sv, "tiff"},
                                          {"MM\0*"sv, "tiff"},
                                          {"\x76\x2f\x31\x01"sv, "openexr"}}};

bool has(std::span<const std::uint8_t> bytes, std::string_view mark, std::size_t at) {
    return bytes.size() >= at + mark.size() && std::memcmp(bytes.data() + at, mark.data(), mark.size()) == 0;
}

}  // namespace

std::string picture_format(std::span<const std::uint8_t> beginning) {
    for (const Magic& known : magics) {
        if (has(beginning, known.bytes, 0)) {
            return std::string(known.format);
        }
    }
    return has(beginning, "RIFF", 0) && has(beginning, "WEBP", 8) ? "webp" : "";
}

// After six bytes of signature, width and height of the canvas, little-endian (GIF89a, section 18).
std::string opening_problem(const std::string& format, std::span<const std::uint8_t> beginning, std::size_t file_bytes) {
    if (format != "gif" || beginning.size() < 10) {
        return "";
    }
    const auto number = [&](std::size_t at) { return beginning[at] + 256 * beginning[at + 1]; };
    return size_claim_problem(number(6), number(8), 4, file_bytes);
}

std::vector<std::uint8_t> beginning_of(const std::filesystem::path& path) {
    std::vector<std::uint8_t> bytes(16);
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
}

std::string picture_format(const std::filesystem::path& path) {
    const std::string format = picture_format(beginning_of(path));
    if (!format.empty()) {
        return format;
    }
    std::string extension = path.extension().string();
    extension.erase(0, 1);
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

}  // namespace diptych::core
