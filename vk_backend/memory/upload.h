// Copies host arrays to device buffers through one staging buffer.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "memory/buffer.h"

namespace diptych::core {

/// Collects copies until the staging buffer is full, then submits them together. finish() submits the rest. The staging
/// buffer is smaller than `capacity` where memory is short.
class Uploader {
public:
    explicit Uploader(const Gpu& gpu, std::uint64_t capacity = std::uint64_t{64} << 20U);

    /// Queues a copy of the bytes to the start of `buffer`.
    void upload(const Buffer& buffer, std::span<const std::byte> bytes);
    void finish();

private:
    struct Copy {
        vk::Buffer target;
        vk::BufferCopy region;
    };

    const Gpu& gpu_;
    Buffer staging_;
    std::uint64_t used_ = 0;
    std::vector<Copy> copies_;
};

/// Creates a device buffer for the elements, with eTransferDst added to its usage. For no elements nothing is
/// allocated.
template <typename T>
Buffer upload_array(const Gpu& gpu, Uploader& uploader, Purpose purpose, std::span<const T> elements,
                    vk::BufferUsageFlags usage) {
    Buffer buffer = make_buffer(gpu, purpose, elements.size_bytes(), usage | vk::BufferUsageFlagBits::eTransferDst,
                                MemoryKind::device);
    uploader.upload(buffer, std::as_bytes(elements));
    return buffer;
}

}  // namespace diptych::core
