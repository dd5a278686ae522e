// ReSTIR's passes on the device: their pipelines and what they keep for every pixel.
#pragma once

#include <cstdint>

#include "memory/buffer.h"
#include "passes/pass.h"
#include "render/resampling_schedule.h"
#include "memory/scene_addresses.h"

namespace diptych::core {

struct ResamplingMemory {
    Buffer first_vertices;
    Buffer reservoirs;
    Buffer surfaces;
    Buffer candidate_list;  // of a slice, those that need rays, after its indirect command
};

/// The buffers that the constants' integrator needs.
ResamplingMemory make_resampling_memory(const Gpu& gpu, const shared::RenderConstants& constants);

/// Whether these are the buffers that the constants ask for.
bool fits(const ResamplingMemory& memory, const shared::RenderConstants& constants);

void enter_resampling(SceneAddresses& addresses, const ResamplingMemory& memory);

std::uint64_t resampling_memory_bytes(const ResamplingMemory& memory);

/// Whether reuse traces rays: its passes are compute shaders otherwise.
bool reuse_traces(const shared::RenderConstants& constants);

/// The shader with which a stage begins, a ray generation shader if it traces.
Spirv resampling_shader(ResamplingStage stage, const shared::RenderConstants& constants);

/// Pipelines of the stage of candidates, none of them owned.
struct CandidatePipelines {
    const ComputePipeline* picked = nullptr;
    const TracePipeline* bsdf = nullptr;     // null where no material is sampled
    const TracePipeline* shares = nullptr;   // null where reservoirs are not handed on either
    const TracePipeline* shadows = nullptr;  // null where none is tested
};

/// Records the stage of candidates for the slice that `dispatch` tells of.
void record_candidates(Recorder& recorder, const CandidatePipelines& pipelines, const PipelineLayout& layout,
                       const Bindings& bindings, const ResamplingMemory& memory, const shared::Dispatch& dispatch);

}  // namespace diptych::core
