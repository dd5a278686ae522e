#include "commands/recorder.h"

#include <vector>

namespace diptych::core {
namespace {

using Flags = vk::AccessFlagBits;
using Stage = vk::PipelineStageFlagBits;

/// Indexed by Unit.
struct UnitMasks {
    vk::PipelineStageFlags stage;
    vk::AccessFlags writes;
    vk::AccessFlags reads;
};
const std::array<UnitMasks, static_cast<std::size_t>(Unit::count)> masks = {{
    {Stage::eTransfer, Flags::eTransferWrite, Flags::eTransferRead},
    // A build reads vertices, instances and transforms with shader-read access.
    {Stage::eAccelerationStructureBuildKHR, Flags::eAccelerationStructureWriteKHR,
     Flags::eAccelerationStructureReadKHR | Flags::eShaderRead},
    {Stage::eComputeShader, Flags::eShaderWrite, Flags::eShaderRead | Flags::eUniformRead},
    {Stage::eRayTracingShaderKHR, Flags::eShaderWrite,
     Flags::eShaderRead | Flags::eUniformRead | Flags::eAccelerationStructureReadKHR},
    {Stage::eDrawIndirect, {}, Flags::eIndirectCommandRead},
    {Stage::eHost, {}, Flags::eHostRead},
}};

UnitMasks masks_of(Units units) {
    UnitMasks all;
    for (std::size_t i = 0; i < masks.size(); ++i) {
        if ((units & bit(static_cast<Unit>(i))) != 0) {
            all.stage |= masks[i].stage;
            all.writes |= masks[i].writes;
            all.reads |= masks[i].reads;
        }
    }
    return all;
}

}  // namespace

Recorder::Recorder(const vk::raii::CommandBuffer& commands) : commands_(commands) {
    const vk::MemoryBarrier barrier{.srcAccessMask = Flags::eMemoryWrite,
                                    .dstAccessMask = Flags::eMemoryRead | Flags::eMemoryWrite};
    commands_.pipelineBarrier(Stage::eAllCommands, Stage::eAllCommands, {}, barrier, {}, {});
}

void Recorder::use(std::span<const Use> uses, std::initializer_list<Use> more) {
    std::vector<Use> all(uses.begin(), uses.end());
    all.insert(all.end(), more.begin(), more.end());
    if (const std::optional<Barrier> needed = hazards_.next(all)) {
        const UnitMasks before = masks_of(needed->before);
        const UnitMasks after = masks_of(needed->after);
        const vk::MemoryBarrier barrier{.srcAccessMask = before.writes, .dstAccessMask = after.reads | after.writes};
        commands_.pipelineBarrier(before.stage, after.stage, {}, barrier, {}, {});
    }
}

}  // namespace diptych::core
