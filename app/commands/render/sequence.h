// Pictures of a scene over time.
#pragma once

#include <cstdint>
#include <string>

#include "commands/render/kept_work.h"
#include "render/device_loss.h"
#include "render/request.h"
#include "scene/scene.h"

namespace diptych::core::app {

class LiveView;
class RankRun;

/// The file of one frame: the last run of # in the name becomes its number, padded with zeros; without any, frame 7 of
/// out.exr is out.0007.exr, unless there is only one.
std::string frame_path(const std::string& output, std::uint32_t frame, std::uint32_t frames);

struct SequenceOptions {
    std::uint32_t first_frame = 0;
    WorkFiles files;
    DeviceLossPolicy on_device_lost;
    bool json = false;         // one list at the end, not a line for each picture
    LiveView* live = nullptr;  // is shown each picture
    RankRun* run = nullptr;    // divides the frames, none of which goes on from another, among several processes
};

/// Renders frames options.first_frame .. request.frames - 1 with one renderer, moved from moment to moment. Frames that
/// are finished are left alone. Frames that go on from one another look back: they begin again at the first, or
/// request.warm_up frames before the first that is not finished. So they do after a loss of the device. Returns the exit
/// code; an interrupt leaves what is finished, and the frame it met as a part. Throws Error.
int render_sequence(const Scene& scene, const RenderRequest& request, const SequenceOptions& options);

}  // namespace diptych::core::app
