#include "pipelines/compute_shader.h"

#include <vector>

#include "commands/commands.h"

namespace diptych::core {

ComputeShader::ComputeShader(const Gpu& gpu, std::span<const std::uint32_t> spirv, std::uint32_t buffers) : gpu_(gpu) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (std::uint32_t i = 0; i < buffers; ++i) {
        bindings.push_back({.binding = i,
                            .descriptorType = vk::DescriptorType::eStorageBuffer,
                            .descriptorCount = 1,
                            .stageFlags = vk::ShaderStageFlagBits::eCompute});
    }
    set_layout_ = gpu.device.createDescriptorSetLayout({.bindingCount = buffers, .pBindings = bindings.data()});
    const vk::PushConstantRange push{.stageFlags = vk::ShaderStageFlagBits::eCompute,
                                     .size = 2 * sizeof(std::uint32_t)};
    layout_ = gpu.device.createPipelineLayout(
        {.setLayoutCount = 1, .pSetLayouts = &*set_layout_, .pushConstantRangeCount = 1, .pPushConstantRanges = &push});
    const vk::raii::ShaderModule module =
        gpu.device.createShaderModule({.codeSize = spirv.size_bytes(), .pCode = spirv.data()});
    const vk::ComputePipelineCreateInfo info{
        .stage = {.stage = vk::ShaderStageFlagBits::eCompute, .module = *module, .pName = "main"}, .layout = *layout_};
    pipeline_ = gpu.device.createComputePipeline(nullptr, info);
    const vk::DescriptorPoolSize size{.type = vk::DescriptorType::eStorageBuffer, .descriptorCount = buffers};
    pool_ = gpu.device.createDescriptorPool({.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                             .maxSets = 1,
                                             .poolSizeCount = 1,
                                             .pPoolSizes = &size});
    set_ = std::move(
        gpu.device
            .allocateDescriptorSets({.descriptorPool = *pool_, .descriptorSetCount = 1, .pSetLayouts = &*set_layout_})
            .front());
}

void ComputeShader::run(std::span<const Buffer* const> buffers, std::uint32_t count, std::uint32_t chosen) {
    for (std::uint32_t i = 0; i < buffers.size(); ++i) {
        const vk::DescriptorBufferInfo info{.buffer = *buffers[i]->handle, .offset = 0, .range = VK_WHOLE_SIZE};
        gpu_.device.updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = *set_,
                                                                .dstBinding = i,
                                                                .descriptorCount = 1,
                                                                .descriptorType = vk::DescriptorType::eStorageBuffer,
                                                                .pBufferInfo = &info},
                                         {});
    }
    run_commands(gpu_, [&](const vk::raii::CommandBuffer& commands) {
        commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
        commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, *set_, {});
        commands.pushConstants<std::uint32_t>(*layout_, vk::ShaderStageFlagBits::eCompute, 0, {count, chosen});
        commands.dispatch((count + 63) / 64, 1, 1);
    });
}

Buffer make_storage(const Gpu& gpu, std::uint64_t bytes) {
    using Bits = vk::BufferUsageFlagBits;
    return make_buffer(gpu, Purpose::other, bytes, Bits::eStorageBuffer | Bits::eTransferSrc | Bits::eTransferDst,
                       MemoryKind::device);
}

}  // namespace diptych::core
