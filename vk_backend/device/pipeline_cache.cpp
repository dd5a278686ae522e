#include "device/pipeline_cache.h"

#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include "digest.h"
#include "image/atomic_file.h"

namespace diptych::core {
namespace {

struct Header {
    std::array<char, 8> magic = {'d', 'i', 'p', 't', 'y', 'c', 'h', '1'};
    std::uint64_t size = 0;
    std::uint64_t hash = 0;
};

std::string hex(std::span<const std::uint8_t> bytes) {
    std::string text;
    for (const std::uint8_t byte : bytes) {
        text += "0123456789abcdef"[byte >> 4U];
        text += "0123456789abcdef"[byte & 15U];
    }
    return text;
}

}  // namespace

std::filesystem::path pipeline_cache_path(const Gpu& gpu) {
    std::filesystem::path folder;
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0') {
        folder = cache;
    } else if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') {
        folder = std::filesystem::path(home) / ".cache";
    } else {
        return {};
    }
    const auto properties =
        gpu.physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceIDProperties>();
    const auto& uuid = properties.get<vk::PhysicalDeviceIDProperties>().deviceUUID;
    const std::uint32_t version = properties.get<vk::PhysicalDeviceProperties2>().properties.driverVersion;
    return folder / "diptych" / ("pipelines-" + hex({uuid.data(), uuid.size()}) + "-" + std::to_string(version));
}

std::vector<unsigned char> read_pipeline_cache(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    Header header;
    const Header expected;
    if (bytes.size() < sizeof(header)) {
        return {};
    }
    std::memcpy(&header, bytes.data(), sizeof(header));
    std::vector<unsigned char> payload(bytes.begin() + sizeof(header), bytes.end());
    if (header.magic != expected.magic || header.size != payload.size() || header.hash != digest_of(payload)) {
        return {};
    }
    return payload;
}

void write_pipeline_cache(const std::filesystem::path& path, std::span<const unsigned char> bytes) {
    Header header;
    header.size = bytes.size();
    header.hash = digest_of(bytes);
    std::vector<unsigned char> whole(sizeof(header) + bytes.size());
    std::memcpy(whole.data(), &header, sizeof(header));
    std::copy(bytes.begin(), bytes.end(), whole.begin() + sizeof(header));
    std::error_code ignored;
    std::filesystem::create_directories(path.parent_path(), ignored);
    try {
        write_file_atomically(path, whole);
    } catch (const Error&) {
    }
}

vk::raii::PipelineCache open_pipeline_cache(const Gpu& gpu, const std::filesystem::path& path) {
    const std::vector<unsigned char> bytes = path.empty() ? std::vector<unsigned char>{} : read_pipeline_cache(path);
    return gpu.device.createPipelineCache({.initialDataSize = bytes.size(), .pInitialData = bytes.data()});
}

void save_pipeline_cache(const vk::raii::PipelineCache& cache, const std::filesystem::path& path) {
    if (path.empty()) {
        return;
    }
    const std::vector<std::uint8_t> bytes = cache.getData();
    if (bytes != read_pipeline_cache(path)) {
        write_pipeline_cache(path, bytes);
    }
}

}  // namespace diptych::core
