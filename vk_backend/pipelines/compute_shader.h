// A compute shader over storage buffers, for tests that evaluate a function on the device.
#pragma once

#include <cstdint>
#include <span>

#include "memory/buffer.h"

namespace diptych::core {

class ComputeShader {
public:
    /// Bindings 0 .. buffers-1 of set 0 are storage buffers. The push constants are two words: the number of
    /// invocations and `chosen`. The workgroup size is 64.
    ComputeShader(const Gpu& gpu, std::span<const std::uint32_t> spirv, std::uint32_t buffers);

    /// Runs invocations 0 .. count-1 and waits.
    void run(std::span<const Buffer* const> buffers, std::uint32_t count, std::uint32_t chosen);

private:
    const Gpu& gpu_;
    vk::raii::DescriptorSetLayout set_layout_ = nullptr;
    vk::raii::PipelineLayout layout_ = nullptr;
    vk::raii::Pipeline pipeline_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::raii::DescriptorSet set_ = nullptr;
};

/// A device buffer that shaders read and write, and that the host copies to and from.
Buffer make_storage(const Gpu& gpu, std::uint64_t bytes);

}  // namespace diptych::core
