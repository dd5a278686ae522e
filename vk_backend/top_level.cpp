#include "acceleration.h"
#include "commands.h"
#include "upload.h"

namespace diptych {
namespace {

using Usage = vk::BufferUsageFlagBits;

std::vector<vk::AccelerationStructureInstanceKHR> describe_instances(const PackedScene& packed,
                                                                     const BottomLevels& bottom) {
    std::vector<vk::AccelerationStructureInstanceKHR> described;
    described.reserve(packed.instances.size());
    for (std::size_t i = 0; i < packed.instances.size(); ++i) {
        const shared::Instance& instance = packed.instances[i];
        vk::AccelerationStructureInstanceKHR target{};  // its bit fields have no initialisers of their own
        for (std::size_t column = 0; column < 4; ++column) {
            const auto c = static_cast<glm::length_t>(column);
            target.transform.matrix[0][column] = instance.row_0[c];
            target.transform.matrix[1][column] = instance.row_1[c];
            target.transform.matrix[2][column] = instance.row_2[c];
        }
        target.mask = 0xff;
        target.setFlags(vk::GeometryInstanceFlagBitsKHR::eTriangleFacingCullDisable);
        target.accelerationStructureReference = bottom.addresses[packed.instance_meshes[i]];
        described.push_back(target);
    }
    return described;
}

}  // namespace

TopLevel build_top_level(const Gpu& gpu, const PackedScene& packed, const BottomLevels& bottom) {
    const std::vector<vk::AccelerationStructureInstanceKHR> described = describe_instances(packed, bottom);
    Uploader uploader(gpu, std::uint64_t{8} << 20U);
    // Instances lie at multiples of 16 bytes; with none, the address still has to be one.
    const std::vector<vk::AccelerationStructureInstanceKHR> unused(1);
    const Buffer instances = upload_array(
        gpu, uploader, "instances of acceleration structures", std::span(described.empty() ? unused : described),
        Usage::eAccelerationStructureBuildInputReadOnlyKHR | Usage::eShaderDeviceAddress);
    uploader.finish();

    vk::AccelerationStructureGeometryInstancesDataKHR data;
    data.data.deviceAddress = instances.address;
    vk::AccelerationStructureGeometryKHR geometry;
    geometry.geometryType = vk::GeometryTypeKHR::eInstances;
    geometry.geometry.instances = data;
    vk::AccelerationStructureBuildGeometryInfoKHR info;
    info.type = vk::AccelerationStructureTypeKHR::eTopLevel;
    info.flags = vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace;
    info.mode = vk::BuildAccelerationStructureModeKHR::eBuild;
    info.setGeometries(geometry);
    const auto count = static_cast<std::uint32_t>(described.size());
    const vk::AccelerationStructureBuildSizesInfoKHR sizes =
        gpu.device.getAccelerationStructureBuildSizesKHR(vk::AccelerationStructureBuildTypeKHR::eDevice, info, count);

    TopLevel top;
    top.storage =
        make_buffer(gpu, "the instances' acceleration structure", sizes.accelerationStructureSize,
                    Usage::eAccelerationStructureStorageKHR | Usage::eShaderDeviceAddress, MemoryKind::device);
    top.structure = gpu.device.createAccelerationStructureKHR({.buffer = *top.storage.handle,
                                                               .size = sizes.accelerationStructureSize,
                                                               .type = vk::AccelerationStructureTypeKHR::eTopLevel});
    const Buffer scratch =
        make_buffer(gpu, "building acceleration structures", sizes.buildScratchSize + gpu.scratch_alignment,
                    Usage::eStorageBuffer | Usage::eShaderDeviceAddress, MemoryKind::device);
    info.dstAccelerationStructure = *top.structure;
    info.scratchData.deviceAddress = align_up(scratch.address, gpu.scratch_alignment);
    const vk::AccelerationStructureBuildRangeInfoKHR range{.primitiveCount = count};
    const vk::AccelerationStructureBuildRangeInfoKHR* ranges = &range;
    run_commands(gpu, [&](const vk::raii::CommandBuffer& commands) {
        commands.buildAccelerationStructuresKHR(info, ranges);
        full_barrier(commands);
    });
    return top;
}

}  // namespace diptych
