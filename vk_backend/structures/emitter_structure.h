// The acceleration structure that holds the emitters alone, in world space: one bottom level under a top level of one
// instance. Primitives count as lights do.
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
    std::vector<shared::vec3> corners;  // as it was built
    std::uint64_t revision = 0;         // of the emissive triangles that it describes
};

/// Nothing where the settings do not search emitters.
EmitterStructure build_emitters(const Gpu& gpu, const PackedScene& packed);

/// For another moment or other settings of the same scene; built anew, in its own memory, only where an emitter moved,
/// went on or off. Nothing that reads it may be in flight.
void move_emitters(const Gpu& gpu, const PackedScene& packed, EmitterStructure& emitters);

inline std::uint64_t emitter_bytes(const EmitterStructure& emitters) {
    return emitters.bottom_storage.size + emitters.top_storage.size;
}

}  // namespace diptych::core
