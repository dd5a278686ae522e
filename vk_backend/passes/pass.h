// What every pass does before it dispatches or traces.
#pragma once

#include <cstdint>

#include "../../shaders/dispatch.h"
#include "../../shaders/wave.h"
#include "pipelines/bindings.h"
#include "pipelines/pipeline.h"
#include "commands/slices.h"

namespace diptych::core {

/// Invocations of a compute shader in groups of WAVE_GROUP that any device takes at a time.
constexpr std::uint64_t most_invocations = std::uint64_t{65535} * shared::WAVE_GROUP;

/// Groups of WAVE_GROUP.
std::uint32_t groups_for(std::uint64_t invocations);

/// Tells a pass its slice.
void tell(shared::Dispatch& dispatch, const Slice& slice);

/// Waits for what the pass depends on, and binds the pipeline, what it reads, and what it is told. `more` is what its
/// command uses beside its shaders.
void bind_pass(Recorder& recorder, const TracePipeline& pipeline, const PipelineLayout& layout,
               const Bindings& bindings, const shared::Dispatch& dispatch, std::initializer_list<Use> more = {});
void bind_pass(Recorder& recorder, const ComputePipeline& compute, const PipelineLayout& layout,
               const Bindings& bindings, const shared::Dispatch& dispatch, std::initializer_list<Use> more = {});

/// Computes over the region of the slice that `dispatch` tells of, with a shader of region.glsl.
void compute_region(Recorder& recorder, const ComputePipeline& compute, const PipelineLayout& layout,
                    const Bindings& bindings, const shared::Dispatch& dispatch);

}  // namespace diptych::core
