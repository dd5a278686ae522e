// The renderer that was asked for.
#pragma once

#include <memory>

#include "pack/packed_scene.h"
#include "render/render_request.h"
#include "render/renderer.h"

namespace diptych::app {

/// Throws NoDevice where there is no suitable one, Error where the program was built without that backend.
std::unique_ptr<Renderer> make_renderer(const PackedScene& packed, const RenderRequest& request);

}  // namespace diptych::app
