// Buffers and images, each with its own memory.
#pragma once

#include <cstdint>

#include "device/gpu.h"

namespace diptych::core {

enum class MemoryKind {
    device,    // the GPU's own
    upload,    // written by the host
    readback,  // read by the host
};

struct Buffer {
    vk::raii::DeviceMemory memory = nullptr;
    vk::raii::Buffer handle = nullptr;
    std::uint64_t size = 0;
    vk::DeviceAddress address = 0;  // where the usage has eShaderDeviceAddress
    void* mapped = nullptr;         // where the host can reach it
};

/// Bytes of the largest heap that has these flags.
std::uint64_t largest_heap(const Gpu& gpu, vk::MemoryHeapFlags flags = {});

/// Throws Error where memory runs out, naming `what`. A size of 0 gives a buffer without handle, at address 0.
Buffer make_buffer(const Gpu& gpu, const char* what, std::uint64_t size, vk::BufferUsageFlags usage, MemoryKind kind);

/// Memory of the GPU's own, bound to the image. Throws vk::SystemError where it runs out.
vk::raii::DeviceMemory allocate_image(const Gpu& gpu, const vk::raii::Image& image);

/// The smallest multiple of `alignment` (a power of two) that is not below `value`.
constexpr std::uint64_t align_up(std::uint64_t value, std::uint64_t alignment) {
    return (value + alignment - 1) & ~(alignment - 1);
}

}  // namespace diptych::core
