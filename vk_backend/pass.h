// What every pass does before it dispatches or traces.
#pragma once

#include <cstdint>

#include "../shaders/dispatch.h"
#include "../shaders/wave.h"
#include "bindings.h"
#include "pipeline.h"
#include "slices.h"

namespace diptych {

/// Invocations of a compute shader in groups of WAVE_GROUP that any device takes at a time.
constexpr std::uint64_t most_invocations = std::uint64_t{65535} * shared::WAVE_GROUP;

/// Groups of WAVE_GROUP.
std::uint32_t groups_for(std::uint64_t invocations);

/// Tells a pass its slice.
void tell(shared::Dispatch& dispatch, const Slice& slice);

/// Binds the pipeline, what it reads, and what it is told.
void bind_pass(const vk::raii::CommandBuffer& commands, const TracePipeline& pipeline, const PipelineLayout& layout,
               const Bindings& bindings, const shared::Dispatch& dispatch);
void bind_pass(const vk::raii::CommandBuffer& commands, const vk::raii::Pipeline& compute, const PipelineLayout& layout,
               const Bindings& bindings, const shared::Dispatch& dispatch);

/// Computes over the region of the slice that `dispatch` tells of, with a shader of region.glsl.
void compute_region(const vk::raii::CommandBuffer& commands, const vk::raii::Pipeline& compute,
                    const PipelineLayout& layout, const Bindings& bindings, const shared::Dispatch& dispatch);

}  // namespace diptych
