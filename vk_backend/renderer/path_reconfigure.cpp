// Changes settings of the same scene. Data that a change does not affect stay on the device.

#include "clock.h"
#include "error.h"
#include "renderer/path_renderer.h"

namespace diptych::core {
// Until the last line nothing is bound. If memory runs out midway, the renderer refuses to render until it gets
// settings that fit.
void PathRenderer::reconfigure(const PackedScene& packed) {
    const std::size_t groups = bottom_.groups.groups.size();
    if (packed.instances.size() + groups != top_.described.size() ||
        packed.meshes.size() + groups != bottom_.addresses.size() ||
        packed.positions.size() * sizeof(shared::vec3) != scene_.positions.size ||
        packed.triangles.size() * sizeof(shared::uvec3) != scene_.triangles.size) {
        throw Error("Vulkan device " + gpu_->name + ": these are the settings of another scene");
    }
    upkeep_->drain();
    bindings_ = Bindings();
    constants_ = packed.constants;
    features_ = packed.features;
    const Stopwatch building;
    say("uploading what differs of the scene");
    in_context("uploading what differs of the scene", [&] { replace_scene(*gpu_, packed, scene_); });
    in_context("building acceleration structures", [&] { replace_structures_of(packed); });
    in_context("making the film", [&] { replace_film(); });
    costs_.build_seconds += building.seconds();

    const Stopwatch compiling;
    in_context("setting up pipelines", [&] {
        choose_pipelines();
        bind();
    });
    costs_.compile_seconds += compiling.seconds();
    schedule_ = ResamplingSchedule(constants_);
    speed_ = SpeedEstimate(dispatch_seconds_);
    recording_speed_.reset();
    queue_->forget_labels();
    count_bytes();
}

void PathRenderer::replace_structures_of(const PackedScene& packed) {
    if (first_moved(packed, bottom_)) {
        build_structures(packed);
        return;
    }
    move_top_level(*gpu_, packed, bottom_, top_);
    move_emitters(*gpu_, packed, emitters_);
    if (!packed.keeps_previous) {
        const TopLevel gone = std::exchange(previous_top_, TopLevel());
    } else if (previous_top_.storage.size == 0) {
        previous_top_ = build_top_level(*gpu_, packed, bottom_);
    } else {
        move_top_level(*gpu_, packed, bottom_, previous_top_);
    }
}

void PathRenderer::replace_film() {
    begin_film();
    replace_waves();
    if (!fits(*resampling_, constants_)) {
        resampling_ = std::make_shared<ResamplingMemory>(make_resampling_memory(*gpu_, constants_));
    }
    reservoir_set_.reset();
}

}  // namespace diptych::core
