#include "gltf/write_file.h"

#include "error.h"

#include <cctype>
#include <cstring>
#include <fstream>

namespace diptych::core::gltf {

std::string file_part(std::string name) {
    for (char& c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_') {
            c = '-';
        }
    }
    return name;
}

std::string encoded_uri(const std::string& name) {
    std::string out;
    for (const char c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0 || std::strchr("-_.~", c) != nullptr) {
            out += c;
        } else {
            constexpr const char* digits = "0123456789ABCDEF";
            const auto byte = static_cast<unsigned char>(c);
            out += {'%', digits[byte >> 4U], digits[byte & 15U]};
        }
    }
    return out;
}

void write_whole(const std::filesystem::path& path, std::initializer_list<std::string_view> pieces) {
    std::filesystem::path temporary = path;
    temporary += ".tmp";
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    for (const std::string_view piece : pieces) {
        file.write(piece.data(), std::streamsize(piece.size()));
    }
    file.close();
    std::error_code error;
    if (file) {
        std::filesystem::rename(temporary, path, error);
    }
    if (!file || error) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw Error(path.string() + ": cannot be written" + (error ? ": " + error.message() : ""));
    }
}

}  // namespace diptych::core::gltf
