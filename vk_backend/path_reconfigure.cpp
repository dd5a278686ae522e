// Other settings of the same scene: what they do not touch stays on the device.
#include <chrono>

#include "error.h"
#include "path_renderer.h"

namespace diptych {

void PathRenderer::reconfigure(const PackedScene& packed) {
    using Clock = std::chrono::steady_clock;
    const auto seconds_since = [](Clock::time_point start) {
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    if (packed.instances.size() != top_.described.size() || packed.meshes.size() != bottom_.addresses.size() ||
        packed.positions.size() * sizeof(shared::vec3) != scene_.positions.size ||
        packed.triangles.size() * sizeof(shared::uvec3) != scene_.triangles.size) {
        throw Error("Vulkan device " + gpu_->name + ": these are the settings of another scene");
    }
    const Clock::time_point start = Clock::now();
    const shared::RenderConstants before = constants_;
    const std::uint32_t features_before = features_;
    constants_ = packed.constants;
    features_ = packed.features;
    in_context("setting up pipelines", [&] { choose_pipelines(); });
    costs_.compile_seconds += seconds_since(start);

    const Clock::time_point build_start = Clock::now();
    in_context("uploading what differs of the scene", [&] { replace_scene(*gpu_, packed, scene_); });
    in_context("building acceleration structures", [&] {
        move_top_level(*gpu_, packed, bottom_, top_);
        if (!packed.keeps_previous) {
            previous_top_ = TopLevel();
        } else if (previous_top_.storage.size == 0) {
            previous_top_ = build_top_level(*gpu_, packed, bottom_);
        } else {
            move_top_level(*gpu_, packed, bottom_, previous_top_);
        }
    });
    in_context("making the film", [&] {
        constexpr std::uint32_t layers = shared::FEATURE_STANDARD_ERROR | shared::FEATURE_FIRST_HIT_LAYERS;
        const bool same_size = constants_.size.x == before.size.x && constants_.size.y == before.size.y;
        if (same_size && (features_ & layers) == (features_before & layers)) {
            diptych::clear_film(*gpu_, *film_);
        } else {
            const auto size = glm::ivec2(constants_.size);
            film_ = std::make_shared<FilmMemory>(make_film(*gpu_, size.x, size.y, features_));
        }
        const ResamplingSets sets = resampling_sets(constants_);
        const ResamplingSets sets_before = resampling_sets(before);
        if (!same_size || sets.first_vertices != sets_before.first_vertices ||
            sets.reservoirs != sets_before.reservoirs || sets.surfaces != sets_before.surfaces) {
            resampling_ = std::make_shared<ResamplingMemory>(make_resampling_memory(*gpu_, constants_));
        }
        bind(packed);
    });
    schedule_ = ResamplingSchedule(constants_);
    reservoir_set_ = 0;
    speed_ = SpeedEstimate(dispatch_seconds_);
    recording_speed_.reset();
    queue_->forget_labels();
    costs_.build_seconds += seconds_since(build_start);
    count_bytes();
}

}  // namespace diptych
