// Common steps of all passes before a dispatch or a trace.
#pragma once

#include <cstdint>

#include "../../shaders/dispatch.h"
#include "../../shaders/wave.h"
#include "pipelines/bindings.h"
#include "pipelines/pipeline.h"
#include "commands/slices.h"

namespace diptych::core {

/// The most invocations, in workgroups of WAVE_GROUP, of one dispatch.
std::uint64_t most_invocations(const Gpu& gpu);

/// Number of workgroups of WAVE_GROUP.
std::uint32_t groups_for(std::uint64_t invocations);

/// Writes the slice into the pass's parameters.
void tell(shared::Dispatch& dispatch, const Slice& slice);

/// Waits for the pass's dependencies, then binds the pipeline, its bindings and its parameters. `more` are uses of the
/// command beside those of its shaders.
void bind_pass(Recorder& recorder, const TracePipeline& pipeline, const PipelineLayout& layout,
               const Bindings& bindings, const shared::Dispatch& dispatch, std::initializer_list<Use> more = {});
void bind_pass(Recorder& recorder, const ComputePipeline& compute, const PipelineLayout& layout,
               const Bindings& bindings, const shared::Dispatch& dispatch, std::initializer_list<Use> more = {});

/// Dispatches a shader of region.glsl over the region of the slice in `dispatch`.
void compute_region(Recorder& recorder, const ComputePipeline& compute, const PipelineLayout& layout,
                    const Bindings& bindings, const shared::Dispatch& dispatch);

}  // namespace diptych::core
