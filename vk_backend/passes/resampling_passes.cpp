#include "passes/resampling_passes.h"

#include <array>

#include "shader_binaries.h"

namespace diptych::core {
namespace {

using Usage = vk::BufferUsageFlagBits;

Buffer film_buffer(const Gpu& gpu, std::uint64_t bytes,
                   vk::BufferUsageFlags more = Usage::eTransferSrc) {
    return bytes == 0 ? Buffer{}
                      : make_buffer(gpu, Purpose::reservoirs, bytes,
                                    Usage::eStorageBuffer | Usage::eShaderDeviceAddress | more, MemoryKind::device);
}

constexpr std::array<std::uint32_t, 3> empty_list = {0, 1, 1};  // an indirect command

struct Bytes {
    std::uint64_t first_vertices;
    std::uint64_t reservoirs;
    std::uint64_t surfaces;
    std::uint64_t candidate_list;
};

Bytes bytes_for(const shared::RenderConstants& constants) {
    const ResamplingSets sets = resampling_sets(constants);
    const std::uint64_t pixels = std::uint64_t{constants.size.x} * constants.size.y;
    return {.first_vertices = pixels * sets.first_vertices * sizeof(shared::FirstVertex),
            .reservoirs = pixels * sets.reservoirs * sizeof(shared::Reservoir),
            .surfaces = pixels * sets.surfaces * sizeof(shared::ReuseSurface),
            .candidate_list = sets.first_vertices > 0 && constants.resampling.bsdf_candidates != 0
                                  ? sizeof(empty_list) + pixels * sizeof(shared::CandidateRequest)
                                  : 0};
}

}  // namespace

ResamplingMemory make_resampling_memory(const Gpu& gpu, const shared::RenderConstants& constants) {
    const Bytes bytes = bytes_for(constants);
    return {.first_vertices = film_buffer(gpu, bytes.first_vertices),
            .reservoirs = film_buffer(gpu, bytes.reservoirs),
            .surfaces = film_buffer(gpu, bytes.surfaces),
            .candidate_list = film_buffer(gpu, bytes.candidate_list,
                                          Usage::eIndirectBuffer | Usage::eTransferDst)};
}

bool fits(const ResamplingMemory& memory, const shared::RenderConstants& constants) {
    const Bytes bytes = bytes_for(constants);
    return memory.first_vertices.size == bytes.first_vertices && memory.reservoirs.size == bytes.reservoirs &&
           memory.surfaces.size == bytes.surfaces && memory.candidate_list.size == bytes.candidate_list;
}

void enter_resampling(SceneAddresses& addresses, const ResamplingMemory& memory) {
    addresses.first_vertices = memory.first_vertices.address;
    addresses.reservoirs = memory.reservoirs.address;
    addresses.reuse_surfaces = memory.surfaces.address;
    addresses.candidate_list = memory.candidate_list.address;
}

std::uint64_t resampling_memory_bytes(const ResamplingMemory& memory) {
    return memory.first_vertices.size + memory.reservoirs.size + memory.surfaces.size + memory.candidate_list.size;
}

std::uint64_t resampling_memory_bytes(const shared::RenderConstants& constants) {
    const Bytes bytes = bytes_for(constants);
    return bytes.first_vertices + bytes.reservoirs + bytes.surfaces + bytes.candidate_list;
}

bool reuse_traces(const shared::RenderConstants& constants) {
    return constants.resampling.visibility == shared::VISIBILITY_IN_TARGET;
}

Spirv resampling_shader(ResamplingStage stage, const shared::RenderConstants& constants) {
    switch (stage) {
    case ResamplingStage::first_hits:
        return shader_binary("restir_first_hits.rgen");
    case ResamplingStage::candidates:
        return shader_binary("restir_candidates.comp");
    case ResamplingStage::temporal:
        return shader_binary(reuse_traces(constants) ? "restir_temporal.rgen" : "restir_temporal.comp");
    case ResamplingStage::spatial:
        return shader_binary(reuse_traces(constants) ? "restir_spatial.rgen" : "restir_spatial.comp");
    case ResamplingStage::shadows:
        return shader_binary("restir_shadows.rgen");
    case ResamplingStage::shade:
        break;
    }
    return shader_binary("restir_shade.comp");
}

void record_candidates(Recorder& recorder, const CandidatePipelines& pipelines, const PipelineLayout& layout,
                       const Bindings& bindings, const ResamplingMemory& memory, const shared::Dispatch& dispatch) {
    if (pipelines.bsdf != nullptr) {
        recorder.use({{Resource::candidate_list, Unit::transfer, Effect::write}});
        recorder->updateBuffer<std::uint32_t>(*memory.candidate_list.handle, 0, empty_list);
    }
    compute_region(recorder, *pipelines.picked, layout, bindings, dispatch);
    const auto trace_listed = [&](const TracePipeline& pipeline, const shared::Dispatch& told) {
        bind_pass(recorder, pipeline, layout, bindings, told,
                  {{Resource::candidate_list, Unit::indirect, Effect::read}});
        trace_indirect(recorder, pipeline, memory.candidate_list.address);
    };
    if (pipelines.bsdf != nullptr) {
        if (pipelines.shares != nullptr) {
            trace_listed(*pipelines.shares, dispatch);
        }
        shared::Dispatch again = dispatch;
        for (std::uint32_t i = 0; i < shared::BSDF_CANDIDATES_NARROW; ++i) {
            again.pass.iteration = i;
            trace_listed(*pipelines.bsdf, again);
        }
    }
    if (pipelines.shadows != nullptr) {
        bind_pass(recorder, *pipelines.shadows, layout, bindings, dispatch);
        trace(recorder, *pipelines.shadows, dispatch.region.x, dispatch.region.y);
    }
}

}  // namespace diptych::core
