#include "resampling_passes.h"

#include "shader_binaries.h"

namespace diptych {
namespace {

Buffer film_buffer(const Gpu& gpu, const char* what, std::uint64_t bytes) {
    return bytes == 0
               ? Buffer{}
               : make_buffer(gpu, what, bytes,
                             vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eShaderDeviceAddress |
                                 vk::BufferUsageFlagBits::eTransferSrc,
                             MemoryKind::device);
}

struct Bytes {
    std::uint64_t first_vertices;
    std::uint64_t reservoirs;
    std::uint64_t surfaces;
};

Bytes bytes_for(const shared::RenderConstants& constants) {
    const ResamplingSets sets = resampling_sets(constants);
    const std::uint64_t pixels = std::uint64_t{constants.size.x} * constants.size.y;
    return {.first_vertices = pixels * sets.first_vertices * sizeof(shared::FirstVertex),
            .reservoirs = pixels * sets.reservoirs * sizeof(shared::Reservoir),
            .surfaces = pixels * sets.surfaces * sizeof(shared::ReuseSurface)};
}

}  // namespace

ResamplingMemory make_resampling_memory(const Gpu& gpu, const shared::RenderConstants& constants) {
    const Bytes bytes = bytes_for(constants);
    return {.first_vertices = film_buffer(gpu, "first vertices", bytes.first_vertices),
            .reservoirs = film_buffer(gpu, "reservoirs", bytes.reservoirs),
            .surfaces = film_buffer(gpu, "reuse surfaces", bytes.surfaces)};
}

bool fits(const ResamplingMemory& memory, const shared::RenderConstants& constants) {
    const Bytes bytes = bytes_for(constants);
    return memory.first_vertices.size == bytes.first_vertices && memory.reservoirs.size == bytes.reservoirs &&
           memory.surfaces.size == bytes.surfaces;
}

void enter_resampling(SceneAddresses& addresses, const ResamplingMemory& memory) {
    addresses.first_vertices = memory.first_vertices.address;
    addresses.reservoirs = memory.reservoirs.address;
    addresses.reuse_surfaces = memory.surfaces.address;
}

std::uint64_t resampling_memory_bytes(const ResamplingMemory& memory) {
    return memory.first_vertices.size + memory.reservoirs.size + memory.surfaces.size;
}

Spirv resampling_shader(ResamplingStage stage) {
    switch (stage) {
    case ResamplingStage::first_hits:
        return shader_binary("restir_first_hits.rgen");
    case ResamplingStage::candidates:
        return shader_binary("restir_candidates.rgen");
    case ResamplingStage::temporal:
        return shader_binary("restir_temporal.rgen");
    case ResamplingStage::spatial:
        return shader_binary("restir_spatial.rgen");
    case ResamplingStage::shadows:
        return shader_binary("restir_shadows.rgen");
    case ResamplingStage::shade:
        break;
    }
    return shader_binary("restir_shade.comp");
}

}  // namespace diptych
