#include <algorithm>

#include "structures/acceleration.h"
#include "commands/commands.h"
#include "memory/upload.h"

namespace diptych::core {
namespace {

constexpr std::uint64_t structure_alignment =
    256;  // of an acceleration structure within its buffer, by the specification

using Usage = vk::BufferUsageFlagBits;

struct StructureBuild {
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

/// Adds the geometries of a mesh. Vertices are transformed by the matrix at the device address `transform`.
void add_mesh(const PackedScene& packed, const SceneMemory& scene, std::size_t mesh, vk::DeviceAddress transform,
              StructureBuild& build) {
    const MeshRange& range = packed.meshes[mesh];
    for (std::uint32_t i = range.first_geometry; i < range.first_geometry + range.geometry_count; ++i) {
        const std::uint32_t count = packed.geometry_extents[i].triangle_count;
        build.geometries.push_back(describe_geometry(packed, scene, i));
        build.geometries.back().geometry.triangles.transformData.deviceAddress = transform;
        build.ranges.push_back({.primitiveCount = count});
        build.triangles += count;
    }
}

void size_build(const Gpu& gpu, StructureBuild& build) {
    std::vector<std::uint32_t> counts;
    for (const vk::AccelerationStructureBuildRangeInfoKHR& range : build.ranges) {
        counts.push_back(range.primitiveCount);
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
}

/// Meshes that need no structure of their own, because all their instances are grouped.
std::vector<bool> meshes_grouped_away(const PackedScene& packed, const InstanceGroups& groups) {
    std::vector<bool> away(packed.meshes.size(), false);
    for (const bool grouped : {true, false}) {
        for (std::size_t i = 0; i < packed.instances.size(); ++i) {
            if (is_grouped(groups, i) == grouped) {
                away[packed.instance_meshes[i]] = grouped;
            }
        }
    }
    return away;
}

/// The matrix that divides by a mesh's unit.
vk::TransformMatrixKHR into_unit(float unit) {
    vk::TransformMatrixKHR transform;
    for (int row = 0; row < 3; ++row) {
        transform.matrix[row] = {};
        transform.matrix[row][row] = 1 / unit;
    }
    return transform;
}

/// The matrices that builds apply to vertices: one for each mesh, into its unit, then those of all grouped instances
/// in the order of the groups.
Buffer upload_transforms(const Gpu& gpu, const PackedScene& packed, const InstanceGroups& groups,
                         const std::vector<float>& units) {
    std::vector<vk::TransformMatrixKHR> transforms;
    std::transform(units.begin(), units.end(), std::back_inserter(transforms), into_unit);
    for (const InstanceGroup& group : groups.groups) {
        for (const std::uint32_t instance : group.instances) {
            transforms.push_back(transform_of(packed.instances[instance]));
        }
    }
    Uploader uploader(gpu, std::uint64_t{4} << 20U);
    Buffer buffer =
        upload_array(gpu, uploader, Purpose::structure_scratch, std::span<const vk::TransformMatrixKHR>(transforms),
                     Usage::eAccelerationStructureBuildInputReadOnlyKHR | Usage::eShaderDeviceAddress);
    uploader.finish();
    return buffer;
}

Buffer structure_buffer(const Gpu& gpu, std::uint64_t bytes) {
    return make_buffer(gpu, Purpose::structures, bytes,
                       Usage::eAccelerationStructureStorageKHR | Usage::eShaderDeviceAddress, MemoryKind::device);
}

vk::raii::AccelerationStructureKHR place_structure(const Gpu& gpu, const Buffer& storage, std::uint64_t offset,
                                                   std::uint64_t bytes) {
    return gpu.device.createAccelerationStructureKHR({.buffer = *storage.handle,
                                                      .offset = offset,
                                                      .size = bytes,
                                                      .type = vk::AccelerationStructureTypeKHR::eBottomLevel});
}

// The builds of one batch, in a buffer that is freed after compaction.
struct Batch {
    Buffer storage;
    std::vector<vk::raii::AccelerationStructureKHR> structures;
    std::vector<std::uint64_t> compacted_bytes;
};

Batch build_batch(const Gpu& gpu, std::span<StructureBuild> builds) {
    std::uint64_t structure_bytes = 0;
    std::uint64_t scratch_bytes = 0;
    for (const StructureBuild& build : builds) {
        structure_bytes += build.structure_bytes;
        scratch_bytes += build.scratch_bytes;
    }
    Batch batch;
    batch.storage = structure_buffer(gpu, structure_bytes);
    const Buffer scratch = make_buffer(gpu, Purpose::structure_scratch, scratch_bytes + gpu.scratch_alignment,
                                       Usage::eStorageBuffer | Usage::eShaderDeviceAddress, MemoryKind::device);
    vk::DeviceAddress scratch_address = align_up(scratch.address, gpu.scratch_alignment);
    std::uint64_t offset = 0;
    std::vector<vk::AccelerationStructureBuildGeometryInfoKHR> infos;
    std::vector<const vk::AccelerationStructureBuildRangeInfoKHR*> ranges;
    std::vector<vk::AccelerationStructureKHR> handles;
    for (StructureBuild& build : builds) {
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
    run_commands(gpu, [&](Recorder& recorder) {
        recorder->resetQueryPool(*queries, 0, count);
        recorder.use(uses_of_build);
        recorder->buildAccelerationStructuresKHR(infos, ranges);
        recorder.use({{Resource::structures, Unit::build, Effect::read}});
        recorder->writeAccelerationStructuresPropertiesKHR(
            handles, vk::QueryType::eAccelerationStructureCompactedSizeKHR, *queries, 0);
    });
    batch.compacted_bytes =
        queries
            .getResults<std::uint64_t>(0, count, count * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                       vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait)
            .second;
    return batch;
}

void compact_batch(const Gpu& gpu, const Batch& batch, std::span<const std::size_t> indices, BottomLevels& levels) {
    std::uint64_t bytes_of_all = 0;
    for (const std::uint64_t bytes : batch.compacted_bytes) {
        bytes_of_all += align_up(bytes, structure_alignment);
    }
    levels.storage.push_back(structure_buffer(gpu, bytes_of_all));
    levels.bytes += bytes_of_all;
    levels.built_bytes += batch.storage.size;
    std::uint64_t offset = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const std::uint64_t bytes = align_up(batch.compacted_bytes[i], structure_alignment);
        levels.structures[indices[i]] = place_structure(gpu, levels.storage.back(), offset, bytes);
        offset += bytes;
    }
    run_commands(gpu, [&](Recorder& recorder) {
        for (std::size_t i = 0; i < indices.size(); ++i) {  // the copies do not overlap
            recorder->copyAccelerationStructureKHR({.src = *batch.structures[i],
                                                    .dst = *levels.structures[indices[i]],
                                                    .mode = vk::CopyAccelerationStructureModeKHR::eCompact});
        }
    });
}

/// Builds and compacts. Where memory is short it goes in halves; a single structure stays as it was built if there is
/// no room for its compacted copy.
void build_and_compact(const Gpu& gpu, std::span<StructureBuild> builds, std::span<const std::size_t> indices,
                       BottomLevels& levels) {
    const std::size_t half = builds.size() / 2;
    try {
        Batch batch = build_batch(gpu, builds);
        try {
            compact_batch(gpu, batch, indices, levels);
        } catch (const OutOfMemory&) {
            if (half > 0) {
                throw;
            }
            levels.bytes += batch.storage.size;
            levels.built_bytes += batch.storage.size;
            levels.storage.push_back(std::move(batch.storage));
            levels.structures[indices.front()] = std::move(batch.structures.front());
        }
    } catch (const OutOfMemory&) {
        if (half == 0) {
            throw;
        }
        build_and_compact(gpu, builds.first(half), indices.first(half), levels);
        build_and_compact(gpu, builds.subspan(half), indices.subspan(half), levels);
        return;
    }
    for (const std::size_t index : indices) {
        levels.addresses[index] =
            gpu.device.getAccelerationStructureAddressKHR({.accelerationStructure = *levels.structures[index]});
    }
}

std::uint64_t triangles_of(const PackedScene& packed, std::size_t mesh) {
    const MeshRange& range = packed.meshes[mesh];
    std::uint64_t triangles = 0;
    for (std::uint32_t i = range.first_geometry; i < range.first_geometry + range.geometry_count; ++i) {
        triangles += packed.geometry_extents[i].triangle_count;
    }
    return triangles;
}

}  // namespace

BuildBytes largest_build(const Gpu& gpu, const PackedScene& packed, const InstanceGroups& groups) {
    std::vector<std::uint64_t> triangles(packed.meshes.size() + groups.groups.size(), 0);
    const std::vector<bool> away = meshes_grouped_away(packed, groups);
    for (std::size_t i = 0; i < packed.meshes.size(); ++i) {
        triangles[i] = away[i] ? 0 : triangles_of(packed, i);
    }
    for (std::size_t i = 0; i < groups.groups.size(); ++i) {
        for (const std::uint32_t instance : groups.groups[i].instances) {
            triangles[packed.meshes.size() + i] += triangles_of(packed, packed.instance_meshes[instance]);
        }
    }
    const auto most = std::max_element(triangles.begin(), triangles.end());
    if (most == triangles.end() || *most == 0) {
        return {};
    }
    const auto index = static_cast<std::size_t>(most - triangles.begin());
    // Sizes depend on no address, but on whether there is a transform.
    constexpr vk::DeviceAddress some_address = 16;
    StructureBuild build;
    if (index < packed.meshes.size()) {
        add_mesh(packed, {}, index, some_address, build);
    } else {
        for (const std::uint32_t instance : groups.groups[index - packed.meshes.size()].instances) {
            add_mesh(packed, {}, packed.instance_meshes[instance], some_address, build);
        }
    }
    size_build(gpu, build);
    return {build.structure_bytes, build.scratch_bytes};
}

BottomLevels build_bottom_levels(const Gpu& gpu, const PackedScene& packed, const SceneMemory& scene,
                                 const InstanceGroups& groups, const BuildLimits& limits) {
    const std::size_t count = packed.meshes.size() + groups.groups.size();
    BottomLevels levels;
    for (std::size_t i = 0; i < count; ++i) {
        levels.structures.emplace_back(nullptr);
    }
    levels.addresses.resize(count, 0);

    std::vector<StructureBuild> builds;
    std::vector<std::size_t> indices;
    std::uint64_t structure_bytes = 0;
    std::uint64_t scratch_bytes = 0;
    const auto flush = [&] {
        if (!builds.empty()) {
            build_and_compact(gpu, builds, indices, levels);
        }
        builds.clear();
        indices.clear();
        structure_bytes = 0;
        scratch_bytes = 0;
    };
    const auto add = [&](StructureBuild&& build, std::size_t index) {
        size_build(gpu, build);
        if (build.triangles == 0) {
            return;
        }
        if (structure_bytes + build.structure_bytes > limits.structure_bytes ||
            scratch_bytes + build.scratch_bytes > limits.scratch_bytes || builds.size() >= limits.meshes) {
            flush();
        }
        structure_bytes += build.structure_bytes;
        scratch_bytes += build.scratch_bytes;
        builds.push_back(std::move(build));
        indices.push_back(index);
    };
    levels.units = mesh_units(packed, groups);
    const Buffer transforms = upload_transforms(gpu, packed, groups, levels.units);
    vk::DeviceAddress transform = transforms.address;
    const std::vector<bool> away = meshes_grouped_away(packed, groups);
    for (std::size_t i = 0; i < packed.meshes.size(); ++i, transform += sizeof(vk::TransformMatrixKHR)) {
        if (!away[i]) {
            StructureBuild build;
            add_mesh(packed, scene, i, transform, build);
            add(std::move(build), i);
        }
    }
    for (std::size_t i = 0; i < groups.groups.size(); ++i) {
        StructureBuild build;
        for (const std::uint32_t instance : groups.groups[i].instances) {
            add_mesh(packed, scene, packed.instance_meshes[instance], transform, build);
            transform += sizeof(vk::TransformMatrixKHR);
        }
        add(std::move(build), packed.meshes.size() + i);
    }
    flush();
    if (!groups.groups.empty()) {
        levels.groups = groups;
        levels.standing = packed.instances;
        Uploader uploader(gpu, std::uint64_t{4} << 20U);
        levels.grouped_geometries =
            upload_array(gpu, uploader, Purpose::structures, std::span(groups.geometries),
                         Usage::eStorageBuffer | Usage::eShaderDeviceAddress);
        uploader.finish();
    }
    return levels;
}

}  // namespace diptych::core
