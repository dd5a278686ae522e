// ReSTIR's passes on the device: their pipelines and their memory for every pixel.
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
    Buffer candidate_list;  // indirect command, then the pixels of a slice that need rays
};

/// Allocates the buffers that the integrator of the constants needs.
ResamplingMemory make_resampling_memory(const Gpu& gpu, const shared::RenderConstants& constants);

/// Whether the buffers are those that the constants need.
bool fits(const ResamplingMemory& memory, const shared::RenderConstants& constants);

void enter_resampling(SceneAddresses& addresses, const ResamplingMemory& memory);

std::uint64_t resampling_memory_bytes(const ResamplingMemory& memory);

/// Bytes that make_resampling_memory allocates.
std::uint64_t resampling_memory_bytes(const shared::RenderConstants& constants);

/// Whether reuse traces rays. Otherwise its passes are compute shaders.
bool reuse_traces(const shared::RenderConstants& constants);

/// The first shader of a stage; a ray generation shader if the stage traces rays.
Spirv resampling_shader(ResamplingStage stage, const shared::RenderConstants& constants);

/// Pipelines of the stage `candidates`. Not owned.
struct CandidatePipelines {
    const ComputePipeline* picked = nullptr;
    const TracePipeline* bsdf = nullptr;     // null if no material is sampled
    const TracePipeline* shares = nullptr;   // null if reservoirs are not reused either
    const TracePipeline* shadows = nullptr;  // null if no candidate is tested for visibility
};

/// Records the stage `candidates` for the slice in `dispatch`.
void record_candidates(Recorder& recorder, const CandidatePipelines& pipelines, const PipelineLayout& layout,
                       const Bindings& bindings, const ResamplingMemory& memory, const shared::Dispatch& dispatch);

}  // namespace diptych::core
