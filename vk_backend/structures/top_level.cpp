#include <array>
#include <cstring>
#include <string>
#include <tuple>

#include "structures/acceleration.h"
#include "commands/commands.h"
#include "memory/upload.h"

namespace diptych::core {
namespace {

using Usage = vk::BufferUsageFlagBits;

vk::AccelerationStructureInstanceKHR describe_instance(const shared::Instance& placed, float unit, bool shown,
                                                       [[maybe_unused]] std::size_t index,
                                                       vk::DeviceAddress structure) {
    vk::AccelerationStructureInstanceKHR target{};  // bit fields have no default initialisers
    target.transform = transform_of(placed, unit);
    target.mask = MUTANT(CULL_MASK, shown, index < 8) ? 0xff : 0;
    using Flags = vk::GeometryInstanceFlagBitsKHR;
    target.setFlags(MUTANT(ALPHA_IGNORED, Flags::eTriangleFacingCullDisable,
                           Flags::eTriangleFacingCullDisable | Flags::eForceOpaque));
    target.accelerationStructureReference = structure;
    return target;
}

std::vector<vk::AccelerationStructureInstanceKHR> describe_instances(const PackedScene& packed,
                                                                     const BottomLevels& bottom) {
    shared::Instance nowhere{};
    nowhere.row_0 = {1, 0, 0, 0};
    nowhere.row_1 = {0, 1, 0, 0};
    nowhere.row_2 = {0, 0, 1, 0};
    std::vector<vk::AccelerationStructureInstanceKHR> described;
    described.reserve(packed.instances.size() + bottom.groups.groups.size());
    for (std::size_t i = 0; i < packed.instances.size(); ++i) {
        const bool shown = is_shown(packed, i) && !is_grouped(bottom.groups, i);
        described.push_back(
            describe_instance(shown ? packed.instances[i] : nowhere, bottom.units[packed.instance_meshes[i]], shown, i,
                              is_grouped(bottom.groups, i) ? 0 : bottom.addresses[packed.instance_meshes[i]]));
    }
    for (std::size_t i = 0; i < bottom.groups.groups.size(); ++i) {
        described.push_back(
            describe_instance(nowhere, 1, true, described.size(), bottom.addresses[packed.meshes.size() + i]));
        described.back().instanceCustomIndex = (bottom.groups.groups[i].first_entry + 1) & 0xffffffU;
    }
    return described;
}

/// Throws Error unless the moment belongs to the scene that was built.
void check_moment(const Gpu& gpu, const PackedScene& moment, const BottomLevels& bottom, const TopLevel& top) {
    const std::size_t before = top.described.size() - bottom.groups.groups.size();
    if (moment.instances.size() != before) {
        throw Error("Vulkan device " + gpu.name + ": " + std::to_string(moment.instances.size()) +
                    " instances where the moment before had " + std::to_string(before));
    }
    if (const std::optional<std::size_t> moved = first_moved(moment, bottom)) {
        throw Error("Vulkan device " + gpu.name + ": instance " + std::to_string(*moved) +
                    " has moved, which no animation moves");
    }
}

struct TopLevelBuild {
    vk::AccelerationStructureGeometryKHR geometry;
    vk::AccelerationStructureBuildGeometryInfoKHR info;
};

TopLevelBuild describe_build(vk::DeviceAddress instances) {
    vk::AccelerationStructureGeometryInstancesDataKHR data;
    data.data.deviceAddress = instances;
    TopLevelBuild build;
    build.geometry.geometryType = vk::GeometryTypeKHR::eInstances;
    build.geometry.geometry.instances = data;
    build.info.type = vk::AccelerationStructureTypeKHR::eTopLevel;
    build.info.flags = vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace;
    build.info.mode = vk::BuildAccelerationStructureModeKHR::eBuild;
    return build;
}

Buffer upload_instances(const Gpu& gpu, const std::vector<vk::AccelerationStructureInstanceKHR>& described) {
    Uploader uploader(gpu, std::uint64_t{8} << 20U);
    // Instances are aligned to 16 bytes. The address must be valid even if there are no instances.
    const std::vector<vk::AccelerationStructureInstanceKHR> unused(1);
    Buffer instances = upload_array(gpu, uploader, Purpose::structure_scratch,
                                    std::span(described.empty() ? unused : described),
                                    Usage::eAccelerationStructureBuildInputReadOnlyKHR | Usage::eShaderDeviceAddress);
    uploader.finish();
    return instances;
}

Buffer make_scratch(const Gpu& gpu, std::uint64_t bytes) {
    return make_buffer(gpu, Purpose::structure_scratch, bytes + gpu.scratch_alignment,
                       Usage::eStorageBuffer | Usage::eShaderDeviceAddress, MemoryKind::device);
}

void build(const Gpu& gpu, const TopLevel& top, const Buffer& instances, const Buffer& scratch) {
    TopLevelBuild build = describe_build(instances.address);
    build.info.setGeometries(build.geometry);
    build.info.dstAccelerationStructure = *top.structure;
    build.info.scratchData.deviceAddress = align_up(scratch.address, gpu.scratch_alignment);
    const vk::AccelerationStructureBuildRangeInfoKHR range{.primitiveCount =
                                                               static_cast<std::uint32_t>(top.described.size())};
    const vk::AccelerationStructureBuildRangeInfoKHR* ranges = &range;
    run_commands(gpu, [&](Recorder& recorder) {
        recorder.use(uses_of_build);
        recorder->buildAccelerationStructuresKHR(build.info, ranges);
    });
}

}  // namespace

std::optional<std::size_t> first_moved(const PackedScene& packed, const BottomLevels& bottom) {
    const auto place = [](const shared::Instance& instance) {
        return std::tie(instance.row_0, instance.row_1, instance.row_2);
    };
    for (std::size_t i = 0; i < bottom.groups.grouped.size(); ++i) {
        if (is_grouped(bottom.groups, i) &&
            (!is_shown(packed, i) || place(packed.instances[i]) != place(bottom.standing[i]))) {
            return i;
        }
    }
    return {};
}

vk::TransformMatrixKHR transform_of(const shared::Instance& instance, float unit) {
    const std::array<glm::vec4, 3> rows = {instance.row_0, instance.row_1, instance.row_2};
    vk::TransformMatrixKHR transform;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            const bool transposed = MUTANT(INSTANCE_TRANSPOSED, false, column < 3);
            transform.matrix[row][column] =
                (column < 3 ? unit : 1) * (transposed ? rows[column][row] : rows[row][column]);
        }
    }
    return transform;
}

TopLevel build_top_level(const Gpu& gpu, const PackedScene& packed, const BottomLevels& bottom) {
    TopLevel top;
    top.described = describe_instances(packed, bottom);
    top.revision = packed.revisions.instances;
    const Buffer instances = upload_instances(gpu, top.described);
    TopLevelBuild asked = describe_build(instances.address);
    asked.info.setGeometries(asked.geometry);
    const vk::AccelerationStructureBuildSizesInfoKHR sizes = gpu.device.getAccelerationStructureBuildSizesKHR(
        vk::AccelerationStructureBuildTypeKHR::eDevice, asked.info, static_cast<std::uint32_t>(top.described.size()));
    top.scratch_bytes = sizes.buildScratchSize;
    top.storage =
        make_buffer(gpu, Purpose::structures, sizes.accelerationStructureSize,
                    Usage::eAccelerationStructureStorageKHR | Usage::eShaderDeviceAddress, MemoryKind::device);
    top.structure = gpu.device.createAccelerationStructureKHR({.buffer = *top.storage.handle,
                                                               .size = sizes.accelerationStructureSize,
                                                               .type = vk::AccelerationStructureTypeKHR::eTopLevel});
    build(gpu, top, instances, make_scratch(gpu, top.scratch_bytes));
    return top;
}

void move_top_level(const Gpu& gpu, const PackedScene& moment, const BottomLevels& bottom, TopLevel& top) {
    if (top.revision != 0 && top.revision == moment.revisions.instances) {
        return;
    }
    check_moment(gpu, moment, bottom, top);
    std::vector<vk::AccelerationStructureInstanceKHR> described = describe_instances(moment, bottom);
    top.revision = moment.revisions.instances;
    const std::span<const std::byte> next = std::as_bytes(std::span(described));
    if (described.empty() || std::memcmp(next.data(), top.described.data(), next.size()) == 0) {
        return;
    }
    top.described = std::move(described);
    if (top.instances.size == 0) {
        top.instances = upload_instances(gpu, top.described);
        top.scratch = make_scratch(gpu, top.scratch_bytes);
    } else {
        Uploader uploader(gpu, next.size());
        uploader.upload(top.instances, std::as_bytes(std::span(top.described)));
        uploader.finish();
    }
    build(gpu, top, top.instances, top.scratch);
}

}  // namespace diptych::core
