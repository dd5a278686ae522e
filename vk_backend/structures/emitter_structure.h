// The acceleration structure of the emitters alone, in world space: one bottom level under a top level with one
// instance. The index of a primitive is its light id.
#pragma once

#include <cstdint>
#include <vector>

#include "memory/buffer.h"
#include "pack/packed_scene.h"

namespace diptych::core {

struct EmitterStructure {
    Buffer bottom_storage;
    Buffer top_storage;
    vk::raii::AccelerationStructureKHR bottom = nullptr;
    vk::raii::AccelerationStructureKHR top = nullptr;
    std::vector<shared::vec3> corners;  // at the last build
    std::uint64_t revision = 0;         // of the emissive triangles at the last build
};

/// Empty if the settings do not search emitters.
EmitterStructure build_emitters(const Gpu& gpu, const PackedScene& packed);

/// Updates the structure for another moment or other settings of the same scene. It is rebuilt in place only if an
/// emitter moved or was switched on or off. Nothing that reads it may be in flight.
void move_emitters(const Gpu& gpu, const PackedScene& packed, EmitterStructure& emitters);

inline std::uint64_t emitter_bytes(const EmitterStructure& emitters) {
    return emitters.bottom_storage.size + emitters.top_storage.size;
}

}  // namespace diptych::core
