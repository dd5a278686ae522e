#include <algorithm>

#include "acceleration.h"
#include "commands.h"

namespace diptych {
namespace {

constexpr std::uint64_t structure_alignment =
    256;  // of an acceleration structure within its buffer, by the specification

using Usage = vk::BufferUsageFlagBits;

struct MeshBuild {
    std::vector<vk::AccelerationStructureGeometryKHR> geometries;
    std::vector<vk::AccelerationStructureBuildRangeInfoKHR> ranges;
    vk::AccelerationStructureBuildGeometryInfoKHR info;
    std::uint64_t structure_bytes = 0;
    std::uint64_t scratch_bytes = 0;
    std::uint64_t triangles = 0;
};

vk::AccelerationStructureGeometryKHR describe_geometry(const PackedScene& packed, const SceneMemory& scene,
                                                       std::uint32_t index) {
    const shared::Geometry& geometry = packed.geometries[index];
    const GeometryExtent& extent = packed.geometry_extents[index];
    vk::AccelerationStructureGeometryTrianglesDataKHR triangles;
    triangles.vertexFormat = vk::Format::eR32G32B32Sfloat;
    triangles.vertexData.deviceAddress = scene.positions.address + sizeof(shared::vec3) * geometry.first_vertex;
    triangles.vertexStride = sizeof(shared::vec3);
    triangles.maxVertex = std::max(extent.vertex_count, 1U) - 1U;
    triangles.indexType = vk::IndexType::eUint32;
    triangles.indexData.deviceAddress = scene.triangles.address + sizeof(shared::uvec3) * geometry.first_triangle;
    const bool tested = extent.alpha && (packed.features & shared::FEATURE_ALPHA) != 0;
    vk::AccelerationStructureGeometryKHR described;
    described.geometryType = vk::GeometryTypeKHR::eTriangles;
    described.geometry.triangles = triangles;
    described.flags = tested ? vk::GeometryFlagsKHR{} : vk::GeometryFlagBitsKHR::eOpaque;
    return described;
}

MeshBuild describe_mesh(const Gpu& gpu, const PackedScene& packed, const SceneMemory& scene, const MeshRange& mesh) {
    MeshBuild build;
    std::vector<std::uint32_t> counts;
    for (std::uint32_t i = mesh.first_geometry; i < mesh.first_geometry + mesh.geometry_count; ++i) {
        const std::uint32_t count = packed.geometry_extents[i].triangle_count;
        build.geometries.push_back(describe_geometry(packed, scene, i));
        build.ranges.push_back({.primitiveCount = count});
        counts.push_back(count);
        build.triangles += count;
    }
    build.info.type = vk::AccelerationStructureTypeKHR::eBottomLevel;
    build.info.flags = vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace |
                       vk::BuildAccelerationStructureFlagBitsKHR::eAllowCompaction;
    build.info.mode = vk::BuildAccelerationStructureModeKHR::eBuild;
    build.info.setGeometries(build.geometries);
    if (build.triangles > 0) {
        const vk::AccelerationStructureBuildSizesInfoKHR sizes = gpu.device.getAccelerationStructureBuildSizesKHR(
            vk::AccelerationStructureBuildTypeKHR::eDevice, build.info, counts);
        build.structure_bytes = align_up(sizes.accelerationStructureSize, structure_alignment);
        build.scratch_bytes = align_up(sizes.buildScratchSize, gpu.scratch_alignment);
    }
    return build;
}

Buffer structure_buffer(const Gpu& gpu, const char* what, std::uint64_t bytes) {
    return make_buffer(gpu, what, bytes, Usage::eAccelerationStructureStorageKHR | Usage::eShaderDeviceAddress,
                       MemoryKind::device);
}

vk::raii::AccelerationStructureKHR place_structure(const Gpu& gpu, const Buffer& storage, std::uint64_t offset,
                                                   std::uint64_t bytes) {
    return gpu.device.createAccelerationStructureKHR({.buffer = *storage.handle,
                                                      .offset = offset,
                                                      .size = bytes,
                                                      .type = vk::AccelerationStructureTypeKHR::eBottomLevel});
}

// Builds of one batch, in a buffer that lives until they have been compacted.
struct Batch {
    Buffer storage;
    std::vector<vk::raii::AccelerationStructureKHR> structures;
    std::vector<std::uint64_t> compacted_bytes;
};

Batch build_batch(const Gpu& gpu, std::vector<MeshBuild>& builds) {
    std::uint64_t structure_bytes = 0;
    std::uint64_t scratch_bytes = 0;
    for (const MeshBuild& build : builds) {
        structure_bytes += build.structure_bytes;
        scratch_bytes += build.scratch_bytes;
    }
    Batch batch;
    batch.storage = structure_buffer(gpu, "acceleration structures", structure_bytes);
    const Buffer scratch = make_buffer(gpu, "building acceleration structures", scratch_bytes + gpu.scratch_alignment,
                                       Usage::eStorageBuffer | Usage::eShaderDeviceAddress, MemoryKind::device);
    vk::DeviceAddress scratch_address = align_up(scratch.address, gpu.scratch_alignment);
    std::uint64_t offset = 0;
    std::vector<vk::AccelerationStructureBuildGeometryInfoKHR> infos;
    std::vector<const vk::AccelerationStructureBuildRangeInfoKHR*> ranges;
    std::vector<vk::AccelerationStructureKHR> handles;
    for (MeshBuild& build : builds) {
        batch.structures.push_back(place_structure(gpu, batch.storage, offset, build.structure_bytes));
        build.info.setGeometries(build.geometries);
        build.info.dstAccelerationStructure = *batch.structures.back();
        build.info.scratchData.deviceAddress = scratch_address;
        offset += build.structure_bytes;
        scratch_address += build.scratch_bytes;
        infos.push_back(build.info);
        ranges.push_back(build.ranges.data());
        handles.push_back(*batch.structures.back());
    }
    const auto count = static_cast<std::uint32_t>(handles.size());
    const vk::raii::QueryPool queries = gpu.device.createQueryPool(
        {.queryType = vk::QueryType::eAccelerationStructureCompactedSizeKHR, .queryCount = count});
    run_commands(gpu, [&](const vk::raii::CommandBuffer& commands) {
        commands.resetQueryPool(*queries, 0, count);
        commands.buildAccelerationStructuresKHR(infos, ranges);
        full_barrier(commands);
        commands.writeAccelerationStructuresPropertiesKHR(
            handles, vk::QueryType::eAccelerationStructureCompactedSizeKHR, *queries, 0);
    });
    batch.compacted_bytes =
        queries
            .getResults<std::uint64_t>(0, count, count * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                       vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait)
            .second;
    return batch;
}

void compact_batch(const Gpu& gpu, const Batch& batch, std::vector<std::size_t>& meshes, BottomLevels& levels) {
    std::uint64_t total = 0;
    for (const std::uint64_t bytes : batch.compacted_bytes) {
        total += align_up(bytes, structure_alignment);
    }
    levels.storage.push_back(structure_buffer(gpu, "compacted acceleration structures", total));
    levels.bytes += total;
    levels.built_bytes += batch.storage.size;
    std::uint64_t offset = 0;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const std::uint64_t bytes = align_up(batch.compacted_bytes[i], structure_alignment);
        levels.structures[meshes[i]] = place_structure(gpu, levels.storage.back(), offset, bytes);
        offset += bytes;
    }
    run_commands(gpu, [&](const vk::raii::CommandBuffer& commands) {
        full_barrier(commands);
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            commands.copyAccelerationStructureKHR({.src = *batch.structures[i],
                                                   .dst = *levels.structures[meshes[i]],
                                                   .mode = vk::CopyAccelerationStructureModeKHR::eCompact});
        }
        full_barrier(commands);
    });
    for (const std::size_t mesh : meshes) {
        levels.addresses[mesh] =
            gpu.device.getAccelerationStructureAddressKHR({.accelerationStructure = *levels.structures[mesh]});
    }
}

}  // namespace

BottomLevels build_bottom_levels(const Gpu& gpu, const PackedScene& packed, const SceneMemory& scene,
                                 const BuildLimits& limits) {
    BottomLevels levels;
    for (std::size_t i = 0; i < packed.meshes.size(); ++i) {
        levels.structures.emplace_back(nullptr);
    }
    levels.addresses.resize(packed.meshes.size(), 0);

    std::vector<MeshBuild> builds;
    std::vector<std::size_t> meshes;
    std::uint64_t structure_bytes = 0;
    std::uint64_t scratch_bytes = 0;
    const auto flush = [&] {
        if (!builds.empty()) {
            const Batch batch = build_batch(gpu, builds);
            compact_batch(gpu, batch, meshes, levels);
        }
        builds.clear();
        meshes.clear();
        structure_bytes = 0;
        scratch_bytes = 0;
    };
    for (std::size_t i = 0; i < packed.meshes.size(); ++i) {
        MeshBuild build = describe_mesh(gpu, packed, scene, packed.meshes[i]);
        if (build.triangles == 0) {
            continue;
        }
        if (structure_bytes + build.structure_bytes > limits.structure_bytes ||
            scratch_bytes + build.scratch_bytes > limits.scratch_bytes || builds.size() >= limits.meshes) {
            flush();
        }
        structure_bytes += build.structure_bytes;
        scratch_bytes += build.scratch_bytes;
        builds.push_back(std::move(build));
        meshes.push_back(i);
    }
    flush();
    return levels;
}

}  // namespace diptych
