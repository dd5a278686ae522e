// Ray-tracing pipelines with their shader binding tables, and compute pipelines.
#pragma once

#include <cstdint>
#include <span>

#include "memory/buffer.h"
#include "commands/recorder.h"

namespace diptych::core {

using Spirv = std::span<const std::uint32_t>;

/// The layout of every pipeline: structures, addresses, constants, and a Dispatch as push constants.
struct PipelineLayout {
    vk::raii::DescriptorSetLayout set = nullptr;
    vk::raii::PipelineLayout layout = nullptr;
};

/// Shader stages that read the push constants.
constexpr vk::ShaderStageFlags pushed_stages = vk::ShaderStageFlagBits::eRaygenKHR | vk::ShaderStageFlagBits::eCompute;

PipelineLayout make_pipeline_layout(const Gpu& gpu);

/// The shaders of a pipeline. An empty any-hit shader is omitted.
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
    std::span<const Use> uses;  // of the pipeline's pass
};

struct ComputePipeline {
    vk::raii::Pipeline pipeline = nullptr;
    std::span<const Use> uses;
};

/// The specialization constants, in order.
struct PipelineConstants {
    std::uint32_t features = 0;
    std::uint32_t record_rays = 0;  // 0 or 1
    std::uint32_t groups = 0;       // 1 if instances may be grouped
};

/// Compiles the shaders of a trace pipeline. May be called from any thread.
vk::raii::Pipeline compile_trace_shaders(const Gpu& gpu, const PipelineLayout& layout,
                                         const vk::raii::PipelineCache& cache, const PipelineShaders& shaders,
                                         const PipelineConstants& constants);

/// A compiled pipeline with its shader binding table.
TracePipeline with_table(const Gpu& gpu, vk::raii::Pipeline compiled);

/// A pipeline for a compute shader with the layout of all pipelines. May be called from any thread.
vk::raii::Pipeline make_compute_pipeline(const Gpu& gpu, const PipelineLayout& layout,
                                         const vk::raii::PipelineCache& cache, Spirv shader,
                                         const PipelineConstants& constants);

/// Traces as many rays as an indirect command in device memory specifies.
void trace_indirect(const vk::raii::CommandBuffer& commands, const TracePipeline& pipeline, vk::DeviceAddress command);

/// Traces width x height rays.
void trace(const vk::raii::CommandBuffer& commands, const TracePipeline& pipeline, std::uint32_t width,
           std::uint32_t height);

}  // namespace diptych::core
