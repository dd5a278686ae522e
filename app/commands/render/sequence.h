// Pictures of a scene over time.
#pragma once

#include <cstdint>
#include <string>

#include "render/request.h"
#include "scene/scene.h"

namespace diptych::core::app {

class LiveView;

/// The file of one frame: the last run of # in the name becomes its number, padded with zeros; without any, frame 7 of
/// out.exr is out.0007.exr, unless there is only one.
std::string frame_path(const std::string& output, std::uint32_t frame, std::uint32_t frames);

/// Renders request.frames pictures of one renderer, moved from moment to moment; prints a line each, or with `json` one
/// list. Returns the exit code; an interrupt leaves what is finished and saves the frame it met. `live`, unless null,
/// is shown each of them. Throws Error.
int render_sequence(const Scene& scene, const RenderRequest& request, bool json, LiveView* live);

}  // namespace diptych::core::app
