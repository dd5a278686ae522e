// Copies from device buffers to the host.
#pragma once

#include <span>
#include <vector>

#include "memory/buffer.h"

namespace diptych::core {

/// Copies the first bytes of the buffer. Nothing that writes it may be in flight.
void read_buffer(const Gpu& gpu, const Buffer& buffer, std::span<std::byte> bytes);

/// The whole buffer as elements; its usage must have eTransferSrc. Empty if there is no buffer.
template <typename T>
std::vector<T> read_array(const Gpu& gpu, const Buffer& buffer) {
    std::vector<T> elements(buffer.size / sizeof(T));
    read_buffer(gpu, buffer, std::as_writable_bytes(std::span(elements)));
    return elements;
}

}  // namespace diptych::core
