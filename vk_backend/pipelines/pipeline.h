// Ray-tracing pipelines with their shader binding tables, and compute pipelines beside them.
#pragma once

#include <cstdint>
#include <span>

#include "memory/buffer.h"
#include "commands/recorder.h"

namespace diptych::core {

using Spirv = std::span<const std::uint32_t>;

/// What every pipeline binds: structure, addresses, constants; a Dispatch as push constants.
struct PipelineLayout {
    vk::raii::DescriptorSetLayout set = nullptr;
    vk::raii::PipelineLayout layout = nullptr;
};

/// Stages that read the push constants.
constexpr vk::ShaderStageFlags pushed_stages = vk::ShaderStageFlagBits::eRaygenKHR | vk::ShaderStageFlagBits::eCompute;

PipelineLayout make_pipeline_layout(const Gpu& gpu);

/// The shaders of a pipeline; an empty any-hit is left out.
struct PipelineShaders {
    Spirv ray_generation;
    Spirv closest_hit;
    Spirv closest_miss;
    Spirv shadow_miss;
    Spirv closest_any_hit;
    Spirv shadow_any_hit;
};

struct TracePipeline {
    vk::raii::Pipeline pipeline = nullptr;
    Buffer table;
    vk::StridedDeviceAddressRegionKHR ray_generation;
    vk::StridedDeviceAddressRegionKHR miss;
    vk::StridedDeviceAddressRegionKHR hit;
    std::span<const Use> uses;  // of its pass
};

struct ComputePipeline {
    vk::raii::Pipeline pipeline = nullptr;
    std::span<const Use> uses;
};

/// The specialization constants, in order.
struct PipelineConstants {
    std::uint32_t features = 0;
    std::uint32_t record_rays = 0;  // 0 or 1
    std::uint32_t groups = 0;       // 1 where instances may be grouped
};

TracePipeline make_pipeline(const Gpu& gpu, const PipelineLayout& layout, const vk::raii::PipelineCache& cache,
                            const PipelineShaders& shaders, const PipelineConstants& constants);

/// Of a shader that computes over what the pipelines bind.
vk::raii::Pipeline make_compute_pipeline(const Gpu& gpu, const PipelineLayout& layout,
                                         const vk::raii::PipelineCache& cache, Spirv shader,
                                         const PipelineConstants& constants);

/// Traces as many rays as an indirect command in device memory says.
void trace_indirect(const vk::raii::CommandBuffer& commands, const TracePipeline& pipeline, vk::DeviceAddress command);

/// Traces width x height rays.
void trace(const vk::raii::CommandBuffer& commands, const TracePipeline& pipeline, std::uint32_t width,
           std::uint32_t height);

}  // namespace diptych::core
