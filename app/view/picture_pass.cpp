#include "view/picture_pass.h"

#include <cmath>
#include <utility>

#include "error.h"
#if DIPTYCH_VULKAN
#include "commands/commands.h"
#include "display/display_pass.h"
#include "renderer/vulkan_renderer.h"
#endif

namespace diptych::core::app {

#if DIPTYCH_VULKAN

struct PicturePass::Device {
    explicit Device(const GpuRequest& request)
        : gpu(open_gpu(request)), uploader(gpu), commands(*gpu), pass(make_display_pass(*gpu)) {}

    DeviceFilm film_of(const PanelShot* shot) {
        if (shot == nullptr) {
            return {};
        }
        if (shot->device_film) {
            return *shot->device_film;
        }
        if (shot->film && shot->film != uploaded) {
            on_device = uploader.upload(*shot->film);
            uploaded = shot->film;
        }
        return on_device;
    }

    std::shared_ptr<Gpu> gpu;
    FilmUploader uploader;
    CommandSlot commands;
    DisplayPass pass;
    DisplayPicture picture;
    std::shared_ptr<const Film> uploaded;
    DeviceFilm on_device;  // what was uploaded
};

PicturePass::PicturePass(const RenderRequest& request)
    : device_(std::make_unique<Device>(
          GpuRequest{.device = request.device, .validation = validation_wanted(request.validation)})) {}

RendererFactory PicturePass::factory() const {
    return [gpu = device_->gpu](const PackedScene& packed) { return make_vulkan_renderer(gpu, packed); };
}

void PicturePass::draw(const ShownState& shown, const PanelShot* cpu, const PanelShot* vulkan, int width, int height) {
    Device& device = *device_;
    const auto columns = static_cast<std::uint32_t>(width);
    const auto rows = static_cast<std::uint32_t>(height);
    if (device.picture.width != columns || device.picture.height != rows) {
        device.picture = make_display_picture(*device.gpu, device.pass, columns, rows);
    }
    DisplayRequest request;
    request.left = device.film_of(cpu != nullptr ? cpu : vulkan);
    request.right = device.film_of(cpu != nullptr ? vulkan : nullptr);
    request.difference = shown.panel == ShownPanel::difference;
    request.divider =
        shown.panel == ShownPanel::split ? static_cast<std::uint32_t>(std::lround(shown.divider * width)) : columns;
    request.tonemap = shown.tonemap;
    request.exposure_ev = static_cast<float>(shown.exposure);
    device.commands.submit([&](const vk::raii::CommandBuffer& commands) {
        record_display(commands, device.pass, device.picture, request);
    });
    device.commands.wait();
}

Image PicturePass::picture() const {
    return read_display(*device_->gpu, device_->picture);
}

#else

struct PicturePass::Device {};

PicturePass::PicturePass(const RenderRequest&) {
    throw NoDevice("view: this program was built without Vulkan (DIPTYCH_VULKAN=OFF); use --panel cpu");
}

RendererFactory PicturePass::factory() const {
    return {};
}
void PicturePass::draw(const ShownState&, const PanelShot*, const PanelShot*, int, int) {}
Image PicturePass::picture() const {
    return {};
}

#endif

PicturePass::~PicturePass() = default;

}  // namespace diptych::core::app
