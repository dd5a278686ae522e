// The descriptor set of every pipeline: acceleration structures, addresses, constants.
#pragma once

#include "memory/buffer.h"
#include "pipelines/pipeline.h"
#include "memory/scene_addresses.h"
#include "language/scene_types.h"

namespace diptych::core {

struct Bindings {
    Buffer addresses;
    Buffer constants;
    vk::raii::DescriptorPool pool = nullptr;
    vk::DescriptorSet set;  // owned by the pool
};

/// Top-level structures. Where one of the others is missing, the scene's structure replaces it. For the previous
/// moment that is correct, because nothing moves. For the emitters it is a placeholder that must not be traced.
struct Structures {
    vk::AccelerationStructureKHR scene;
    vk::AccelerationStructureKHR previous = nullptr;  // of the moment before
    vk::AccelerationStructureKHR emitters = nullptr;
};

Bindings make_bindings(const Gpu& gpu, const PipelineLayout& layout, const Structures& structures,
                       const SceneAddresses& addresses, const shared::RenderConstants& constants);

/// Records an update of the addresses and constants. The command contains the bytes: a view updates them every frame,
/// and allocating staging memory is expensive.
void record_values(Recorder& recorder, const Bindings& bindings, const SceneAddresses& addresses,
                   const shared::RenderConstants& constants);

/// Replaces the structures. Nothing that uses the set may be in flight.
void replace_structures(const Gpu& gpu, const Bindings& bindings, const Structures& structures);

}  // namespace diptych::core
