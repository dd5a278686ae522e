#include "error.h"
#include "stability_backend.h"
#if DIPTYCH_VULKAN
#include "pipelines/compute_shader.h"
#include "memory/readback.h"
#include "stability_shader_binaries.h"
#include "memory/upload.h"
#include "renderer/vulkan_renderer.h"
#endif

namespace diptych::core::stability {

#if DIPTYCH_VULKAN
namespace {

class VulkanBackend : public Backend {
public:
    VulkanBackend(const std::string& device, bool validation)
        : gpu_(open_gpu({.device = device, .validation = validation_wanted(validation)})),
          shader_(*gpu_, stability_shader_binary("measured.comp"), 2) {}

    std::string name() const override { return "vulkan"; }
    std::string device() const override { return gpu_->name; }

    std::vector<MeasuredOutput> run(Function function, std::span<const MeasuredInput> inputs) override {
        Uploader uploader(*gpu_, std::uint64_t{8} << 20U);
        const Buffer in =
            upload_array(*gpu_, uploader, Purpose::other, inputs, vk::BufferUsageFlagBits::eStorageBuffer);
        uploader.finish();
        const Buffer out = make_storage(*gpu_, inputs.size() * sizeof(MeasuredOutput));
        const Buffer* const buffers[] = {&in, &out};
        shader_.run(buffers, static_cast<std::uint32_t>(inputs.size()), static_cast<std::uint32_t>(function));
        return read_array<MeasuredOutput>(*gpu_, out);
    }

    std::unique_ptr<Renderer> make_renderer(const PackedScene& packed) override {
        return make_vulkan_renderer(gpu_, packed);  // drivers can take seconds to open a device, and some only so often
    }

private:
    std::shared_ptr<Gpu> gpu_;
    ComputeShader shader_;
};

}  // namespace

std::unique_ptr<Backend> make_vulkan_backend(const std::string& device, bool validation) {
    return std::make_unique<VulkanBackend>(device, validation);
}
#else
std::unique_ptr<Backend> make_vulkan_backend(const std::string&, bool) {
    throw Error("--backends vulkan: this program was built without it (DIPTYCH_VULKAN=OFF); use --backends cpu");
}
#endif

}  // namespace diptych::core::stability
