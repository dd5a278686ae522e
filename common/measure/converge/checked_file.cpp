#include "measure/converge/checked_file.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>

#include "digest.h"
#include "error.h"
#include "image/atomic_file.h"
#include "input_file.h"

namespace diptych::core {

namespace {

std::uint64_t checksum(std::string_view bytes) {
    return digest_of({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
}

}  // namespace

void write_checked_file(const std::string& path, std::string bytes) {
    const std::uint64_t sum = checksum(bytes);
    bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
    write_file_atomically(path, bytes);
}

std::optional<std::string> read_checked_file(const std::string& path) {
    if (!std::filesystem::exists(path)) {
        return std::nullopt;
    }
    require_input(path);
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        throw Error(fmt::format("{}: cannot read", path));
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
