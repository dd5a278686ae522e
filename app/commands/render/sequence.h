// Pictures of a scene over time.
#pragma once

#include <cstdint>
#include <string>

#include "commands/render/kept_work.h"
#include "render/request.h"
#include "scene/scene.h"

namespace diptych::core::app {

class LiveView;

/// The file of one frame: the last run of # in the name becomes its number, padded with zeros; without any, frame 7 of
/// out.exr is out.0007.exr, unless there is only one.
std::string frame_path(const std::string& output, std::uint32_t frame, std::uint32_t frames);

/// Renders frames `first_frame` .. request.frames - 1 with one renderer, moved from moment to moment; prints a line each,
/// or with `json` one list. Frames that are finished are left alone. Where frames go on from one another, the frames
/// that the first unfinished one looks back to are rendered again: request.warm_up of them. Returns the exit code; an
/// interrupt leaves what is finished, and the frame it met as a part. `live`, unless null, is shown each frame. Throws
/// Error.
int render_sequence(const Scene& scene, const RenderRequest& request, std::uint32_t first_frame, const WorkFiles& files,
                    bool json, LiveView* live);

}  // namespace diptych::core::app
