#include "gltf/bytes.h"

#include <algorithm>
#include <cctype>

#include "error.h"
#include "input_file.h"

namespace diptych::core::gltf {
namespace {

int hex_digit(char c) {
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    const int lower = std::tolower(static_cast<unsigned char>(c));
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') {
        return c - 'A';
    }
    if (c >= 'a' && c <= 'z') {
        return c - 'a' + 26;
    }
    if (c >= '0' && c <= '9') {
        return c - '0' + 52;
    }
    if (c == '+' || c == '-') {
        return 62;
    }
    return c == '/' || c == '_' ? 63 : -1;
}

std::uint32_t little_endian(const std::vector<std::uint8_t>& bytes, std::size_t at) {
    return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
           static_cast<std::uint32_t>(bytes[at + 2]) << 16 | static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

std::filesystem::path from_utf8(const std::string& text) {
    return std::filesystem::path(std::u8string(text.begin(), text.end()));
}

bool has_scheme(const std::string& uri) {
    const auto end = std::find_if_not(
        uri.begin(), uri.end(), [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '.' || c == '-'; });
    return end != uri.end() && *end == ':' && end - uri.begin() > 1;
}

/// As the file is named, else as it is escaped.
std::filesystem::path path_of_uri(const std::string& uri, const std::filesystem::path& folder) {
    const std::filesystem::path plain = folder / from_utf8(decode_percent(uri));
    const std::filesystem::path escaped = folder / from_utf8(uri);
    std::error_code ignored;
    const bool named_so = !std::filesystem::exists(plain, ignored) && std::filesystem::exists(escaped, ignored);
    return named_so ? escaped : plain;
}

/// Whether the file lies outside the folder: by .., by an absolute path, or by a symbolic link on the way.
bool leads_out(const std::filesystem::path& file, const std::filesystem::path& folder) {
    const auto inside = [](const std::filesystem::path& relative) { return relative.empty() || *relative.begin() != ".."; };
    const std::filesystem::path base = folder.empty() ? "." : folder;
    if (!inside(file.lexically_normal().lexically_relative(base.lexically_normal()))) {
        return true;
    }
    std::error_code failure;
    const std::filesystem::path real_base = std::filesystem::weakly_canonical(base, failure);
    const std::filesystem::path real_file = std::filesystem::weakly_canonical(file, failure);
    return failure || !inside(real_file.lexically_relative(real_base));
}

}  // namespace

std::optional<std::vector<std::uint8_t>> decode_base64(std::string_view text) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        if (c == '=') {
            break;
        }
        if (std::isspace(static_cast<unsigned char>(c))) {
            continue;
        }
        const int digit = base64_digit(c);
        if (digit < 0) {
            return std::nullopt;
        }
        bits = (bits << 6 | static_cast<std::uint32_t>(digit)) & 0xffffffU;
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<std::uint8_t>(bits >> count));
        }
    }
    return bytes;
}

std::string decode_percent(std::string_view text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0) {
            decoded.push_back(static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2])));
            i += 2;
        } else {
            decoded.push_back(text[i]);
        }
    }
    return decoded;
}

std::optional<std::filesystem::path> file_of_uri(const std::string& uri, const std::filesystem::path& folder) {
    const bool embedded = uri.rfind("data:", 0) == 0;
    const bool unusable = uri.empty() || has_scheme(uri) || decode_percent(uri).find('\0') != std::string::npos;
    return embedded || unusable ? std::nullopt : std::optional(path_of_uri(uri, folder));
}

std::vector<std::uint8_t> read_uri(const std::string& uri, const UriRules& rules) {
    if (uri.rfind("data:", 0) == 0) {
        const std::size_t comma = uri.find(',');
        if (comma == std::string::npos) {
            throw Error("the data URI has no comma");
        }
        const std::string_view data = std::string_view(uri).substr(comma + 1);
        rules.budget.ask(data.size());  // no encoding makes them fewer
        if (std::string_view(uri).substr(0, comma).find(";base64") == std::string_view::npos) {
            const std::string plain = decode_percent(data);
            return {plain.begin(), plain.end()};
        }
        std::optional<std::vector<std::uint8_t>> bytes = decode_base64(data);
        if (!bytes) {
            throw Error("the data URI is not valid base64");
        }
        return *std::move(bytes);
    }
    if (uri.empty()) {
        throw Error("the URI is empty");
    }
    if (has_scheme(uri)) {
        throw Error("the URI '" + uri.substr(0, 80) + "' is neither a data URI nor a relative path");
    }
    if (uri.find('\0') != std::string::npos || decode_percent(uri).find('\0') != std::string::npos) {
        throw Error("the URI holds a zero byte");
    }
    const std::filesystem::path file = path_of_uri(uri, rules.folder);
    if (!rules.allow_external && leads_out(file, rules.folder)) {
        throw RefusedUri("the URI '" + uri + "' leads out of the file's folder (`allow_external` reads it)");
    }
    std::error_code unknown;
    if (const std::string problem = input_problem(file); !problem.empty() && std::filesystem::exists(file, unknown)) {
        throw RefusedUri("'" + uri + "': " + problem);
    }
    try {
        return read_file(file, rules.budget);
    } catch (const OverBudget& error) {
        throw OverBudget("'" + uri + "': " + error.what());
    } catch (const Error& error) {
        throw Error("'" + uri + "': " + error.what());
    }
}

bool is_glb(const std::vector<std::uint8_t>& bytes) {
    return bytes.size() >= 4 && bytes[0] == 'g' && bytes[1] == 'l' && bytes[2] == 'T' && bytes[3] == 'F';
}

GlbChunks split_glb(const std::vector<std::uint8_t>& bytes) {
    constexpr std::uint32_t json_chunk = 0x4E4F534A;
    constexpr std::uint32_t binary_chunk = 0x004E4942;
    if (bytes.size() < 20) {
        throw Error("binary glTF: shorter than its header");
    }
    const std::uint32_t version = little_endian(bytes, 4);
    if (version != 2) {
        throw Error("binary glTF: version " + std::to_string(version) + " is not supported, only 2 is");
    }
    const std::size_t length = little_endian(bytes, 8);
    if (length > bytes.size()) {
        throw Error("binary glTF: says it has " + std::to_string(length) + " bytes, the file has " +
                    std::to_string(bytes.size()));
    }
    GlbChunks chunks;
    bool have_json = false;
    for (std::size_t at = 12; at + 8 <= length;) {
        const std::size_t size = little_endian(bytes, at);
        const std::uint32_t type = little_endian(bytes, at + 4);
        at += 8;
        if (size > length - at) {
            throw Error("binary glTF: a chunk of " + std::to_string(size) + " bytes ends past the file");
        }
        if (!have_json) {
            if (type != json_chunk) {
                throw Error("binary glTF: the first chunk is not JSON");
            }
            chunks.json = {reinterpret_cast<const char*>(bytes.data() + at), size};
            have_json = true;
        } else if (type == binary_chunk && !chunks.binary) {
            const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
            chunks.binary.emplace(begin, begin + static_cast<std::ptrdiff_t>(size));
        }
        at += size;
    }
    if (!have_json) {
        throw Error("binary glTF: there is no JSON chunk");
    }
    return chunks;
}

}  // namespace diptych::core::gltf
