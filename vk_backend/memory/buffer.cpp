#include "memory/buffer.h"

#include <algorithm>
#include <initializer_list>
#include <string>

namespace diptych::core {
namespace {

using Property = vk::MemoryPropertyFlagBits;

// Memory properties of each kind, the preferred ones first.
std::initializer_list<vk::MemoryPropertyFlags> wishes(MemoryKind kind) {
    static constexpr vk::MemoryPropertyFlags visible = Property::eHostVisible | Property::eHostCoherent;
    static const std::initializer_list<vk::MemoryPropertyFlags> device = {Property::eDeviceLocal, {}};
    static const std::initializer_list<vk::MemoryPropertyFlags> upload = {visible};
    static const std::initializer_list<vk::MemoryPropertyFlags> readback = {visible | Property::eHostCached, visible};
    return kind == MemoryKind::device ? device : kind == MemoryKind::upload ? upload : readback;
}

std::uint32_t memory_type(const Gpu& gpu, std::uint32_t allowed, MemoryKind kind) {
    for (const vk::MemoryPropertyFlags wish : wishes(kind)) {
        for (std::uint32_t i = 0; i < gpu.memory.memoryTypeCount; ++i) {
            if ((allowed >> i & 1U) != 0 && (gpu.memory.memoryTypes[i].propertyFlags & wish) == wish) {
                return i;
            }
        }
    }
    throw Error("Vulkan device " + gpu.name + ": no fitting memory type");
}

}  // namespace

std::uint64_t largest_heap(const Gpu& gpu, vk::MemoryHeapFlags flags) {
    std::uint64_t bytes = 0;
    for (std::uint32_t i = 0; i < gpu.memory.memoryHeapCount; ++i) {
        const vk::MemoryHeap& heap = gpu.memory.memoryHeaps[i];
        bytes = std::max(bytes, (heap.flags & flags) == flags ? heap.size : 0);
    }
    return bytes;
}

Buffer make_buffer(const Gpu& gpu, const char* what, std::uint64_t size, vk::BufferUsageFlags usage, MemoryKind kind) {
    Buffer buffer;
    if (size == 0) {
        return buffer;
    }
    if (size > largest_heap(gpu)) {  // some drivers accept a larger allocation
        throw Error("Vulkan device " + gpu.name + ": " + what + ": " + std::to_string(size) +
                    " bytes are more than it has");
    }
    in_context(std::string("allocating ") + std::to_string(size) + " bytes for " + what, [&] {
        buffer.handle = gpu.device.createBuffer({.size = size, .usage = usage});
        const vk::MemoryRequirements needs = buffer.handle.getMemoryRequirements();
        const bool addressed = static_cast<bool>(usage & vk::BufferUsageFlagBits::eShaderDeviceAddress);
        const vk::MemoryAllocateFlagsInfo flags{.flags = vk::MemoryAllocateFlagBits::eDeviceAddress};
        buffer.memory = gpu.device.allocateMemory({.pNext = addressed ? &flags : nullptr,
                                                   .allocationSize = needs.size,
                                                   .memoryTypeIndex = memory_type(gpu, needs.memoryTypeBits, kind)});
        buffer.handle.bindMemory(*buffer.memory, 0);
        buffer.size = size;
        if (addressed) {
            buffer.address = gpu.device.getBufferAddress({.buffer = *buffer.handle});
        }
        if (kind != MemoryKind::device) {
            buffer.mapped = buffer.memory.mapMemory(0, VK_WHOLE_SIZE);
        }
    });
    return buffer;
}

vk::raii::DeviceMemory allocate_image(const Gpu& gpu, const vk::raii::Image& image) {
    const vk::MemoryRequirements needs = image.getMemoryRequirements();
    vk::raii::DeviceMemory memory = gpu.device.allocateMemory(
        {.allocationSize = needs.size, .memoryTypeIndex = memory_type(gpu, needs.memoryTypeBits, MemoryKind::device)});
    image.bindMemory(*memory, 0);
    return memory;
}

}  // namespace diptych::core
