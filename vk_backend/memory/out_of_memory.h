// What is said when a device has no room.
#pragma once

#include <cstdint>
#include <string>

#include "device/heap_room.h"

namespace diptych::core {

/// Throws OutOfMemory: what was asked for and by what, what is in use for which purpose, what is free, and what would
/// need less memory. `reason` is the driver's, or empty.
[[noreturn]] void refuse_allocation(const Gpu& gpu, Purpose purpose, std::uint64_t bytes, std::uint32_t heap,
                                    const std::string& reason);

/// The end of such a message: "free: 1.2 GB of 8 GB; " and the advice.
[[noreturn]] void refuse(const Gpu& gpu, const std::string& need, const HeapRoom& room, const std::string& advice);

/// What needs less memory for that purpose: "a smaller `size` or no `layers`".
const char* what_needs_less(Purpose purpose);

}  // namespace diptych::core
