#include "measure/converge/checked_file.h"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string_view>

#include "error.h"
#include "image/atomic_file.h"

namespace diptych::core {

namespace {

/// FNV-1a of 64 bits.
std::uint64_t checksum(std::string_view bytes) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char byte : bytes) {
        hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
    }
    return hash;
}

}  // namespace

void write_checked_file(const std::string& path, std::string bytes) {
    const std::uint64_t sum = checksum(bytes);
    bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
    write_file_atomically(path, bytes);
}

std::optional<std::string> read_checked_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        return std::nullopt;
    }
    std::ostringstream stream;
    stream << file.rdbuf();
    std::string bytes = stream.str();
    std::uint64_t sum = 0;
    if (bytes.size() < sizeof sum) {
        fail_as_damaged(path);
    }
    std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
    bytes.resize(bytes.size() - sizeof sum);
    if (sum != checksum(bytes)) {
        fail_as_damaged(path);
    }
    return bytes;
}

void fail_as_damaged(const std::string& path) {
    throw Error(fmt::format(
        "{}: is damaged; remove it, and what it held is rendered again, or give another `output`", path));
}

}  // namespace diptych::core
