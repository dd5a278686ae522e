#include "structures/emitter_structure.h"

#include <algorithm>
#include <cstring>

#include "structures/acceleration.h"
#include "commands/commands.h"
#include "pack/emitter_corners.h"
#include "memory/upload.h"

namespace diptych::core {
namespace {

using Usage = vk::BufferUsageFlagBits;
using Type = vk::AccelerationStructureTypeKHR;

vk::AccelerationStructureGeometryKHR describe_triangles(vk::DeviceAddress corners, std::uint32_t count) {
    vk::AccelerationStructureGeometryTrianglesDataKHR triangles;
    triangles.vertexFormat = vk::Format::eR32G32B32Sfloat;
    triangles.vertexData.deviceAddress = corners;
    triangles.vertexStride = sizeof(shared::vec3);
    triangles.maxVertex = 3 * count - 1;
    triangles.indexType = vk::IndexType::eNoneKHR;
    vk::AccelerationStructureGeometryKHR described;
    described.geometryType = vk::GeometryTypeKHR::eTriangles;
    described.geometry.triangles = triangles;
    described.flags = vk::GeometryFlagBitsKHR::eOpaque;
    return described;
}

vk::AccelerationStructureGeometryKHR describe_instances(vk::DeviceAddress instances) {
    vk::AccelerationStructureGeometryInstancesDataKHR data;
    data.data.deviceAddress = instances;
    vk::AccelerationStructureGeometryKHR described;
    described.geometryType = vk::GeometryTypeKHR::eInstances;
    described.geometry.instances = data;
    return described;
}

vk::AccelerationStructureInstanceKHR describe_instance(vk::DeviceAddress bottom) {
    vk::AccelerationStructureInstanceKHR instance{};  // bit fields have no default initialisers
    for (int i = 0; i < 3; ++i) {
        instance.transform.matrix[i][i] = 1;
    }
    instance.mask = 0xff;
    instance.setFlags(vk::GeometryInstanceFlagBitsKHR::eTriangleFacingCullDisable);
    instance.accelerationStructureReference = bottom;
    return instance;
}

/// One level: the input and the sizes of its build. `info` points to `geometry`, so a Level must not move.
struct Level {
    vk::AccelerationStructureGeometryKHR geometry;
    vk::AccelerationStructureBuildGeometryInfoKHR info;
    vk::AccelerationStructureBuildRangeInfoKHR range;
    vk::AccelerationStructureBuildSizesInfoKHR sizes;
};

void describe_level(const Gpu& gpu, Type type, const vk::AccelerationStructureGeometryKHR& geometry,
                    std::uint32_t count, Level& level) {
    level.geometry = geometry;
    level.info.type = type;
    level.info.flags = vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace;
    level.info.mode = vk::BuildAccelerationStructureModeKHR::eBuild;
    level.info.setGeometries(level.geometry);
    level.range.primitiveCount = count;
    level.sizes = gpu.device.getAccelerationStructureBuildSizesKHR(vk::AccelerationStructureBuildTypeKHR::eDevice,
                                                                   level.info, count);
}

vk::raii::AccelerationStructureKHR make_structure(const Gpu& gpu, Type type, const Level& level, Buffer& storage) {
    const std::uint64_t bytes = level.sizes.accelerationStructureSize;
    storage = make_buffer(gpu, Purpose::structures, bytes,
                          Usage::eAccelerationStructureStorageKHR | Usage::eShaderDeviceAddress, MemoryKind::device);
    return gpu.device.createAccelerationStructureKHR({.buffer = *storage.handle, .size = bytes, .type = type});
}

/// Builds both levels. Memory is allocated if there is none.
void build(const Gpu& gpu, std::vector<shared::vec3> from, EmitterStructure& emitters) {
    const Usage input = Usage::eAccelerationStructureBuildInputReadOnlyKHR;
    const auto count = static_cast<std::uint32_t>(from.size() / 3);
    Uploader uploader(gpu, std::uint64_t{4} << 20U);
    const Buffer corners = upload_array(gpu, uploader, Purpose::structure_scratch, std::span(std::as_const(from)),
                                        input | Usage::eShaderDeviceAddress);
    Level bottom;
    describe_level(gpu, Type::eBottomLevel, describe_triangles(corners.address, count), count, bottom);
    if (!*emitters.bottom) {
        emitters.bottom = make_structure(gpu, Type::eBottomLevel, bottom, emitters.bottom_storage);
    }
    const vk::AccelerationStructureInstanceKHR described =
        describe_instance(gpu.device.getAccelerationStructureAddressKHR({.accelerationStructure = *emitters.bottom}));
    const Buffer instance = upload_array(gpu, uploader, Purpose::structure_scratch, std::span(&described, 1),
                                         input | Usage::eShaderDeviceAddress);
    uploader.finish();
    Level top;
    describe_level(gpu, Type::eTopLevel, describe_instances(instance.address), 1, top);
    if (!*emitters.top) {
        emitters.top = make_structure(gpu, Type::eTopLevel, top, emitters.top_storage);
    }
    bottom.info.dstAccelerationStructure = *emitters.bottom;
    top.info.dstAccelerationStructure = *emitters.top;
    const std::uint64_t scratch_bytes = std::max(bottom.sizes.buildScratchSize, top.sizes.buildScratchSize);
    const Buffer scratch =
        make_buffer(gpu, Purpose::structure_scratch, scratch_bytes + gpu.scratch_alignment,
                    Usage::eStorageBuffer | Usage::eShaderDeviceAddress, MemoryKind::device);
    run_commands(gpu, [&](Recorder& recorder) {
        for (Level* level : {&bottom, &top}) {  // the top level reads the bottom level
            level->info.scratchData.deviceAddress = align_up(scratch.address, gpu.scratch_alignment);
            recorder.use(uses_of_build);
            recorder->buildAccelerationStructuresKHR(level->info, &level->range);
        }
    });
    emitters.corners = std::move(from);
}

}  // namespace

EmitterStructure build_emitters(const Gpu& gpu, const PackedScene& packed) {
    EmitterStructure emitters;
    if (searches_emitters(packed)) {
        build(gpu, emitter_corners(packed), emitters);
        emitters.revision = packed.revisions.emissive_triangles;
    }
    return emitters;
}

void move_emitters(const Gpu& gpu, const PackedScene& packed, EmitterStructure& emitters) {
    if (!searches_emitters(packed) || 3 * packed.emissive_triangles.size() != emitters.corners.size()) {
        emitters = build_emitters(gpu, packed);
        return;
    }
    const bool known = emitters.revision != 0 && emitters.revision == packed.revisions.emissive_triangles;
    if (MUTANT(EMITTERS_STAY, known, true)) {
        return;
    }
    std::vector<shared::vec3> corners = emitter_corners(packed);
    if (std::memcmp(corners.data(), emitters.corners.data(), corners.size() * sizeof(shared::vec3)) != 0) {
        build(gpu, std::move(corners), emitters);
    }
    emitters.revision = packed.revisions.emissive_triangles;
}

}  // namespace diptych::core
