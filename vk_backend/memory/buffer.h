// Buffers and images, each with memory of its own.
#pragma once

#include <cstdint>

#include "device/gpu.h"

namespace diptych::core {

enum class MemoryKind {
    device,    // device-local
    upload,    // written by the host, read by the device
    readback,  // written by the device, read by the host
};

/// Memory of the device, counted in Gpu::memory_use.
struct Allocation {
    vk::raii::DeviceMemory memory = nullptr;
    MemoryCharge charge;
};

struct Buffer {
    Allocation memory;
    vk::raii::Buffer handle = nullptr;
    std::uint64_t size = 0;
    vk::DeviceAddress address = 0;  // valid if the usage has eShaderDeviceAddress
    void* mapped = nullptr;         // valid if the host can access the memory
};

/// Throws OutOfMemory if memory runs out. A size of 0 gives a buffer without a handle, at address 0.
Buffer make_buffer(const Gpu& gpu, Purpose purpose, std::uint64_t size, vk::BufferUsageFlags usage, MemoryKind kind);

/// The largest buffer from `size` down to `least` that there is memory for, by halves. For what works in parts.
Buffer make_largest_buffer(const Gpu& gpu, Purpose purpose, std::uint64_t size, std::uint64_t least,
                           vk::BufferUsageFlags usage, MemoryKind kind);

/// Allocates device-local memory and binds it to the image. Throws OutOfMemory if memory runs out.
Allocation allocate_image(const Gpu& gpu, const vk::raii::Image& image);

/// The smallest multiple of `alignment` (a power of two) that is at least `value`.
constexpr std::uint64_t align_up(std::uint64_t value, std::uint64_t alignment) {
    return (value + alignment - 1) & ~(alignment - 1);
}

}  // namespace diptych::core
