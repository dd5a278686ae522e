// ReSTIR's passes on the device: their pipelines and what they keep for every pixel.
#pragma once

#include <array>
#include <cstdint>

#include "buffer.h"
#include "pipeline.h"
#include "render/resampling_schedule.h"
#include "scene_addresses.h"

namespace diptych {

constexpr std::size_t resampling_stages = 6;  // of ResamplingStage

struct ResamplingMemory {
    Buffer first_vertices;
    Buffer reservoirs;
    Buffer surfaces;
};

/// The buffers that the constants' integrator needs.
ResamplingMemory make_resampling_memory(const Gpu& gpu, const shared::RenderConstants& constants);

/// Whether these are the buffers that the constants ask for.
bool fits(const ResamplingMemory& memory, const shared::RenderConstants& constants);

void enter_resampling(SceneAddresses& addresses, const ResamplingMemory& memory);

std::uint64_t resampling_memory_bytes(const ResamplingMemory& memory);

/// The ray generation shader of a stage; of shade, the compute shader with which its waves begin.
Spirv resampling_shader(ResamplingStage stage);

}  // namespace diptych
