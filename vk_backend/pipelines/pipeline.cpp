#include "pipelines/pipeline.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

#include "../../shaders/dispatch.h"
#include "memory/upload.h"

namespace diptych::core {
namespace {

using Stage = vk::ShaderStageFlagBits;
constexpr vk::ShaderStageFlags reading_stages =
    Stage::eRaygenKHR | Stage::eClosestHitKHR | Stage::eAnyHitKHR | Stage::eCompute;

vk::RayTracingShaderGroupCreateInfoKHR general_group(std::uint32_t stage) {
    return {.type = vk::RayTracingShaderGroupTypeKHR::eGeneral,
            .generalShader = stage,
            .closestHitShader = VK_SHADER_UNUSED_KHR,
            .anyHitShader = VK_SHADER_UNUSED_KHR,
            .intersectionShader = VK_SHADER_UNUSED_KHR};
}

vk::RayTracingShaderGroupCreateInfoKHR hit_group(std::uint32_t closest_hit, std::uint32_t any_hit) {
    return {.type = vk::RayTracingShaderGroupTypeKHR::eTrianglesHitGroup,
            .generalShader = VK_SHADER_UNUSED_KHR,
            .closestHitShader = closest_hit,
            .anyHitShader = any_hit,
            .intersectionShader = VK_SHADER_UNUSED_KHR};
}

// The result points to `constants`.
vk::SpecializationInfo specialize(const PipelineConstants& constants) {
    static constexpr std::array<vk::SpecializationMapEntry, 3> entries = {{
        {.constantID = 0, .offset = offsetof(PipelineConstants, features), .size = 4},
        {.constantID = 1, .offset = offsetof(PipelineConstants, record_rays), .size = 4},
        {.constantID = 2, .offset = offsetof(PipelineConstants, groups), .size = 4},
    }};
    return {.mapEntryCount = entries.size(),
            .pMapEntries = entries.data(),
            .dataSize = sizeof(constants),
            .pData = &constants};
}

constexpr std::uint32_t group_count = 5;  // ray generation; two miss; two hit

// Each of the three regions starts at a multiple of the base alignment. Within a region, records are spaced by the
// alignment of handles.
void fill_table(const Gpu& gpu, TracePipeline& built) {
    const std::uint64_t handle = gpu.ray_tracing.shaderGroupHandleSize;
    const std::uint64_t base = gpu.ray_tracing.shaderGroupBaseAlignment;
    const std::uint64_t stride = align_up(handle, gpu.ray_tracing.shaderGroupHandleAlignment);
    const std::uint64_t first_stride = align_up(stride, base);
    const std::uint64_t pair = align_up(2 * stride, base);
    const std::vector<std::uint8_t> handles =
        built.pipeline.getRayTracingShaderGroupHandlesKHR<std::uint8_t>(0, group_count, group_count * handle);

    built.table = make_buffer(gpu, Purpose::pipelines, first_stride + 2 * pair + base,
                              vk::BufferUsageFlagBits::eShaderBindingTableKHR |
                                  vk::BufferUsageFlagBits::eShaderDeviceAddress | vk::BufferUsageFlagBits::eTransferDst,
                              MemoryKind::device);
    const vk::DeviceAddress start = align_up(built.table.address, base);
    const std::array<std::uint64_t, group_count> offsets = {0, first_stride, first_stride + stride, first_stride + pair,
                                                            first_stride + pair + stride};
    std::vector<std::byte> records(built.table.size);
    for (std::uint32_t i = 0; i < group_count; ++i) {
        std::memcpy(records.data() + (start - built.table.address) + offsets[i], handles.data() + i * handle, handle);
    }
    Uploader uploader(gpu, records.size());
    uploader.upload(built.table, records);
    uploader.finish();
    built.ray_generation =
        vk::StridedDeviceAddressRegionKHR{.deviceAddress = start, .stride = first_stride, .size = first_stride};
    built.miss =
        vk::StridedDeviceAddressRegionKHR{.deviceAddress = start + offsets[1], .stride = stride, .size = 2 * stride};
    built.hit =
        vk::StridedDeviceAddressRegionKHR{.deviceAddress = start + offsets[3], .stride = stride, .size = 2 * stride};
}

}  // namespace

PipelineLayout make_pipeline_layout(const Gpu& gpu) {
    using Type = vk::DescriptorType;
    const std::array<vk::DescriptorSetLayoutBinding, 5> bindings = {{
        {.binding = 0,
         .descriptorType = Type::eAccelerationStructureKHR,
         .descriptorCount = 1,
         .stageFlags = Stage::eRaygenKHR},
        {.binding = 1, .descriptorType = Type::eUniformBuffer, .descriptorCount = 1, .stageFlags = reading_stages},
        {.binding = 2, .descriptorType = Type::eUniformBuffer, .descriptorCount = 1, .stageFlags = reading_stages},
        {.binding = 3,
         .descriptorType = Type::eAccelerationStructureKHR,
         .descriptorCount = 1,
         .stageFlags = Stage::eRaygenKHR},
        {.binding = 4,
         .descriptorType = Type::eAccelerationStructureKHR,
         .descriptorCount = 1,
         .stageFlags = Stage::eRaygenKHR},
    }};
    PipelineLayout made;
    vk::DescriptorSetLayoutCreateInfo set;
    set.setBindings(bindings);
    made.set = gpu.device.createDescriptorSetLayout(set);
    const vk::PushConstantRange range{.stageFlags = pushed_stages, .size = sizeof(shared::Dispatch)};
    vk::PipelineLayoutCreateInfo layout;
    layout.setSetLayouts(*made.set).setPushConstantRanges(range);
    made.layout = gpu.device.createPipelineLayout(layout);
    return made;
}

vk::raii::Pipeline compile_trace_shaders(const Gpu& gpu, const PipelineLayout& layout,
                                         const vk::raii::PipelineCache& cache, const PipelineShaders& shaders,
                                         const PipelineConstants& constants) {
    const vk::SpecializationInfo specialization = specialize(constants);

    std::vector<vk::raii::ShaderModule> modules;
    std::vector<vk::PipelineShaderStageCreateInfo> stages;
    const auto add_stage = [&](Spirv code, vk::ShaderStageFlagBits stage) {
        if (code.empty()) {
            return VK_SHADER_UNUSED_KHR;
        }
        modules.push_back(gpu.device.createShaderModule({.codeSize = code.size_bytes(), .pCode = code.data()}));
        stages.push_back(
            {.stage = stage, .module = *modules.back(), .pName = "main", .pSpecializationInfo = &specialization});
        return static_cast<std::uint32_t>(stages.size() - 1);
    };
    const std::uint32_t generation = add_stage(shaders.ray_generation, Stage::eRaygenKHR);
    const std::uint32_t closest_miss = add_stage(shaders.closest_miss, Stage::eMissKHR);
    const std::uint32_t shadow_miss = add_stage(shaders.shadow_miss, Stage::eMissKHR);
    const std::uint32_t closest_hit = add_stage(shaders.closest_hit, Stage::eClosestHitKHR);
    const std::uint32_t closest_any_hit = add_stage(shaders.closest_any_hit, Stage::eAnyHitKHR);
    const std::uint32_t shadow_any_hit = add_stage(shaders.shadow_any_hit, Stage::eAnyHitKHR);
    const std::array<vk::RayTracingShaderGroupCreateInfoKHR, group_count> groups = {
        general_group(generation), general_group(closest_miss), general_group(shadow_miss),
        hit_group(closest_hit, closest_any_hit), hit_group(VK_SHADER_UNUSED_KHR, shadow_any_hit)};

    vk::RayTracingPipelineCreateInfoKHR info;
    info.setStages(stages).setGroups(groups);
    info.maxPipelineRayRecursionDepth = 1;
    info.layout = *layout.layout;
    return in_context("compiling the shaders",
                      [&] { return gpu.device.createRayTracingPipelineKHR(nullptr, cache, info); });
}

TracePipeline with_table(const Gpu& gpu, vk::raii::Pipeline compiled) {
    TracePipeline built;
    built.pipeline = std::move(compiled);
    fill_table(gpu, built);
    return built;
}

vk::raii::Pipeline make_compute_pipeline(const Gpu& gpu, const PipelineLayout& layout,
                                         const vk::raii::PipelineCache& cache, Spirv shader,
                                         const PipelineConstants& constants) {
    const vk::SpecializationInfo specialization = specialize(constants);
    const vk::raii::ShaderModule module =
        gpu.device.createShaderModule({.codeSize = shader.size_bytes(), .pCode = shader.data()});
    return in_context("compiling the shaders", [&] {
        return gpu.device.createComputePipeline(cache, {.stage = {.stage = Stage::eCompute,
                                                                  .module = *module,
                                                                  .pName = "main",
                                                                  .pSpecializationInfo = &specialization},
                                                        .layout = *layout.layout});
    });
}

void trace_indirect(const vk::raii::CommandBuffer& commands, const TracePipeline& pipeline, vk::DeviceAddress command) {
    commands.traceRaysIndirectKHR(pipeline.ray_generation, pipeline.miss, pipeline.hit, {}, command);
}

void trace(const vk::raii::CommandBuffer& commands, const TracePipeline& pipeline, std::uint32_t width,
           std::uint32_t height) {
    commands.traceRaysKHR(pipeline.ray_generation, pipeline.miss, pipeline.hit, {}, width, height, 1);
}

}  // namespace diptych::core
