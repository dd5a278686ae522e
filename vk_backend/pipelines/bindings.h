// The descriptor set that every pipeline reads: structure, addresses, constants.
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
    vk::DescriptorSet set;  // the pool's
};

/// Top-level structures. Where a scene or its settings lack one of the others, the first stands in for it: in place of
/// the moment before it means what it says, in place of the emitters it may not be traced.
struct Structures {
    vk::AccelerationStructureKHR scene;
    vk::AccelerationStructureKHR previous = nullptr;  // of the moment before
    vk::AccelerationStructureKHR emitters = nullptr;
};

Bindings make_bindings(const Gpu& gpu, const PipelineLayout& layout, const Structures& structures,
                       const SceneAddresses& addresses, const shared::RenderConstants& constants);

/// Records that others take the place of the addresses and constants that it was made with. The command carries the
/// bytes: a view does this in every frame, and memory for staging is dear to allocate.
void record_values(Recorder& recorder, const Bindings& bindings, const SceneAddresses& addresses,
                   const shared::RenderConstants& constants);

/// Other structures take their places. Nothing that reads the set may be in flight.
void replace_structures(const Gpu& gpu, const Bindings& bindings, const Structures& structures);

}  // namespace diptych::core
