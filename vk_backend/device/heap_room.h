// How much memory a heap of the device has left.
#pragma once

#include <cstdint>

#include "device/gpu.h"

namespace diptych::core {

struct HeapRoom {
    std::uint64_t size = 0;  // of the heap, or what this process may use of it (VK_EXT_memory_budget)
    std::uint64_t free = 0;  // of that
    bool of_host = false;    // it is the machine, or a limit of the process, that leaves no more
};

/// Where the heap lies in the machine's own memory, what the machine and the limits of the process leave counts too. A
/// driver that renders on the CPU may crash at such a limit, so some of it is left to the driver.
HeapRoom heap_room(const Gpu& gpu, std::uint32_t heap);

/// The largest heap that has these flags, and its bytes.
std::uint32_t largest_heap(const Gpu& gpu, vk::MemoryHeapFlags flags = {});
std::uint64_t largest_heap_bytes(const Gpu& gpu, vk::MemoryHeapFlags flags = {});

}  // namespace diptych::core
