// What a scene needs of a device's memory at least, known before anything is allocated.
#pragma once

#include "device/memory_use.h"
#include "structures/acceleration.h"

namespace diptych::core {

/// The two steps that need the most. Both hold the scene's arrays.
struct MemoryPlan {
    BytesByPurpose building = {};   // the largest acceleration structure
    BytesByPurpose rendering = {};  // the film, and what the fewest paths in flight need
};

MemoryPlan plan_memory(const Gpu& gpu, const PackedScene& packed, const InstanceGroups& groups);

/// Throws OutOfMemory where the plan needs more than the device has free: what for, and what would fit. A plan that
/// passes may still run out of memory, as the sizes of compacted structures are not known yet.
void require_memory(const Gpu& gpu, const PackedScene& packed, const InstanceGroups& groups);

}  // namespace diptych::core
