// The descriptor set that every pipeline reads: structure, addresses, constants.
#pragma once

#include "buffer.h"
#include "pipeline.h"
#include "scene_addresses.h"
#include "scene_types.h"

namespace diptych {

struct Bindings {
    Buffer addresses;
    Buffer constants;
    vk::raii::DescriptorPool pool = nullptr;
    vk::DescriptorSet set;  // the pool's
};

/// `previous`: of the moment before; the same where there is none.
Bindings make_bindings(const Gpu& gpu, const PipelineLayout& layout, vk::AccelerationStructureKHR structure,
                       vk::AccelerationStructureKHR previous, const SceneAddresses& addresses,
                       const shared::RenderConstants& constants);

/// Records that others take the place of the addresses and constants that it was made with. The command carries the
/// bytes: a view does this in every frame, and memory for staging is dear to allocate.
void record_values(const vk::raii::CommandBuffer& commands, const Bindings& bindings, const SceneAddresses& addresses,
                   const shared::RenderConstants& constants);

/// Other top-level structures take their places. Nothing that reads the set may be in flight.
void replace_structures(const Gpu& gpu, const Bindings& bindings, vk::AccelerationStructureKHR structure,
                        vk::AccelerationStructureKHR previous);

}  // namespace diptych
