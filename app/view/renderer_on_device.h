// What the view asks of a renderer that runs on a device. Other renderers, and programs built without Vulkan, answer
// with nothing.
#pragma once

#include <memory>

#include "render/renderer.h"

namespace diptych::core {
struct DeviceFilm;
}

namespace diptych::core::app {

/// The renderer's film as it lies on its device; null where it lies on the host.
std::shared_ptr<const DeviceFilm> device_film_of(const Renderer& renderer);

/// Has the renderer cut its work so that none of its dispatches holds the display up for longer than so many seconds.
void aim_dispatches(Renderer& renderer, double seconds);

}  // namespace diptych::core::app
