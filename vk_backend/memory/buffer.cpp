#include "memory/buffer.h"

#include <algorithm>
#include <initializer_list>
#include <string>

#include "memory/out_of_memory.h"

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

constexpr std::uint64_t large = std::uint64_t{1} << 20U;

/// Some drivers accept more than they have, and one that renders on the CPU may crash instead of refusing. To ask how
/// much is free takes some microseconds, so small allocations are left to the driver.
void require_room(const Gpu& gpu, Purpose purpose, std::uint64_t bytes, std::uint32_t heap) {
    const bool limited = gpu.faults.memory < gpu.memory.memoryHeaps[heap].size;
    if (bytes < large && !limited) {
        return;
    }
    const HeapRoom room = heap_room(gpu, heap);
    if (bytes > (gpu.on_cpu || limited ? room.free : room.size)) {
        refuse_allocation(gpu, purpose, bytes, heap, {});
    }
}

/// All memory of the device is allocated here.
Allocation allocate(const Gpu& gpu, Purpose purpose, const vk::MemoryRequirements& needs, MemoryKind kind,
                    const vk::MemoryAllocateFlagsInfo* flags) {
    const std::uint32_t type = memory_type(gpu, needs.memoryTypeBits, kind);
    const std::uint32_t heap = gpu.memory.memoryTypes[type].heapIndex;
    require_room(gpu, purpose, needs.size, heap);
    if (gpu.faults.allocation && gpu.faults.allocation(purpose, needs.size)) {
        refuse_allocation(gpu, purpose, needs.size, heap, "a test");
    }
    try {
        return {gpu.device.allocateMemory({.pNext = flags, .allocationSize = needs.size, .memoryTypeIndex = type}),
                MemoryCharge(gpu.memory_use, purpose, needs.size)};
    } catch (const vk::SystemError& error) {
        if (error.code() != vk::make_error_code(vk::Result::eErrorOutOfDeviceMemory) &&
            error.code() != vk::make_error_code(vk::Result::eErrorOutOfHostMemory)) {
            throw;
        }
        const bool too_large = needs.size > gpu.largest_allocation;
        refuse_allocation(gpu, purpose, needs.size, heap,
                          too_large ? "the device allocates at most " + size_text(gpu.largest_allocation) + " at once"
                                    : error.what());
    }
}

}  // namespace

Buffer make_buffer(const Gpu& gpu, Purpose purpose, std::uint64_t size, vk::BufferUsageFlags usage, MemoryKind kind) {
    Buffer buffer;
    if (size == 0) {
        return buffer;
    }
    if (size > gpu.largest_buffer) {
        refuse_allocation(gpu, purpose, size, largest_heap(gpu),
                          "the device's buffers have at most " + size_text(gpu.largest_buffer));
    }
    in_context("allocating " + size_text(size) + " for " + name_of(purpose), [&] {
        buffer.handle = gpu.device.createBuffer({.size = size, .usage = usage});
        const bool addressed = static_cast<bool>(usage & vk::BufferUsageFlagBits::eShaderDeviceAddress);
        const vk::MemoryAllocateFlagsInfo flags{.flags = vk::MemoryAllocateFlagBits::eDeviceAddress};
        buffer.memory =
            allocate(gpu, purpose, buffer.handle.getMemoryRequirements(), kind, addressed ? &flags : nullptr);
        buffer.handle.bindMemory(*buffer.memory.memory, 0);
        buffer.size = size;
        if (addressed) {
            buffer.address = gpu.device.getBufferAddress({.buffer = *buffer.handle});
        }
        if (kind != MemoryKind::device) {
            buffer.mapped = buffer.memory.memory.mapMemory(0, VK_WHOLE_SIZE);
        }
    });
    return buffer;
}

Buffer make_largest_buffer(const Gpu& gpu, Purpose purpose, std::uint64_t size, std::uint64_t least,
                           vk::BufferUsageFlags usage, MemoryKind kind) {
    while (size > least) {
        try {
            return make_buffer(gpu, purpose, size, usage, kind);
        } catch (const OutOfMemory&) {
            size = std::max(size / 2, least);
        }
    }
    return make_buffer(gpu, purpose, size, usage, kind);
}

Allocation allocate_image(const Gpu& gpu, const vk::raii::Image& image) {
    Allocation allocation = allocate(gpu, Purpose::display, image.getMemoryRequirements(), MemoryKind::device, nullptr);
    image.bindMemory(*allocation.memory, 0);
    return allocation;
}

}  // namespace diptych::core
