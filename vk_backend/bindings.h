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

/// Puts other constants in the place of those it was made with. Nothing that reads them may be in flight.
void replace_constants(const Gpu& gpu, const Bindings& bindings, const shared::RenderConstants& constants);

/// Likewise other addresses.
void replace_addresses(const Gpu& gpu, const Bindings& bindings, const SceneAddresses& addresses);

/// Likewise other top-level structures.
void replace_structures(const Gpu& gpu, const Bindings& bindings, vk::AccelerationStructureKHR structure,
                        vk::AccelerationStructureKHR previous);

}  // namespace diptych
