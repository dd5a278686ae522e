#include "device/heap_room.h"

#include <algorithm>

#include "device/host_memory.h"

namespace diptych::core {
namespace {

constexpr std::uint64_t left_to_driver = std::uint64_t{192} << 20U;  // on the CPU: compiled shaders, threads

std::uint64_t minus(std::uint64_t whole, std::uint64_t part) {
    return whole > part ? whole - part : 0;
}

}  // namespace

HeapRoom heap_room(const Gpu& gpu, std::uint32_t heap) {
    const std::uint64_t ours = total(gpu.memory_use->bytes());
    HeapRoom room{.size = gpu.memory.memoryHeaps[heap].size};
    room.free = minus(room.size, ours);
    if (gpu.has_memory_budget) {
        const auto budget = gpu.physical
                                .getMemoryProperties2<vk::PhysicalDeviceMemoryProperties2,
                                                      vk::PhysicalDeviceMemoryBudgetPropertiesEXT>()
                                .get<vk::PhysicalDeviceMemoryBudgetPropertiesEXT>();
        room.size = std::min(room.size, budget.heapBudget[heap]);
        room.free = minus(room.size, budget.heapUsage[heap]);
    }
    if (gpu.on_cpu || !(gpu.memory.memoryHeaps[heap].flags & vk::MemoryHeapFlagBits::eDeviceLocal)) {
        const std::uint64_t left = minus(host_bytes_left(), gpu.on_cpu ? left_to_driver : 0);
        room.of_host = left < room.free;
        room.free = std::min(room.free, left);
    }
    if (gpu.faults.memory < room.size) {
        room.size = gpu.faults.memory;
        room.of_host = false;
        room.free = std::min(room.free, minus(room.size, ours));
    }
    return room;
}

std::uint32_t largest_heap(const Gpu& gpu, vk::MemoryHeapFlags flags) {
    std::uint32_t largest = 0;
    std::uint64_t bytes = 0;
    for (std::uint32_t i = 0; i < gpu.memory.memoryHeapCount; ++i) {
        const vk::MemoryHeap& heap = gpu.memory.memoryHeaps[i];
        if ((heap.flags & flags) == flags && heap.size > bytes) {
            largest = i;
            bytes = heap.size;
        }
    }
    return largest;
}

std::uint64_t largest_heap_bytes(const Gpu& gpu, vk::MemoryHeapFlags flags) {
    return gpu.memory.memoryHeaps[largest_heap(gpu, flags)].size;
}

}  // namespace diptych::core
