#include "view/renderer_on_device.h"

#if DIPTYCH_VULKAN
#include "renderer/path_renderer.h"
#endif

namespace diptych::core::app {

#if DIPTYCH_VULKAN

std::shared_ptr<const DeviceFilm> device_film_of(const Renderer& renderer) {
    const auto* const on_device = dynamic_cast<const PathRenderer*>(&renderer);
    return on_device == nullptr ? nullptr : std::make_shared<const DeviceFilm>(on_device->device_film());
}

void aim_dispatches(Renderer& renderer, double seconds) {
    if (auto* const on_device = dynamic_cast<PathRenderer*>(&renderer)) {
        on_device->aim_dispatches(seconds);
    }
}

#else

std::shared_ptr<const DeviceFilm> device_film_of(const Renderer&) {
    return nullptr;
}
void aim_dispatches(Renderer&, double) {}

#endif

}  // namespace diptych::core::app
