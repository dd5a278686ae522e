// Device buffers to the host.
#pragma once

#include <span>
#include <vector>

#include "memory/buffer.h"

namespace diptych::core {

/// Copies the buffer's first bytes. Nothing that writes it may be in flight.
void read_buffer(const Gpu& gpu, const Buffer& buffer, std::span<std::byte> bytes);

/// All of a buffer (with eTransferSrc in its usage) as elements; none where there is no buffer.
template <typename T>
std::vector<T> read_array(const Gpu& gpu, const Buffer& buffer) {
    std::vector<T> elements(buffer.size / sizeof(T));
    read_buffer(gpu, buffer, std::as_writable_bytes(std::span(elements)));
    return elements;
}

}  // namespace diptych::core
