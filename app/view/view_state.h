// What a view shows, as plain values: the interface changes them, the engine compares them with what it has done.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "image/tonemap_image.h"
#include "render/moment.h"
#include "render/request.h"
#include "scene/scene.h"

namespace diptych::core::app {

/// All that decides a panel's samples. The film has the size of request.settings.
struct RenderedState {
    std::uint64_t scene = 0;  // generation of the loaded scene (loader.h): another number, another scene
    RenderRequest request;    // settings with the seed, scale and rotation of the environment, the sun
    Camera camera;            // seen through, lens and field of view included; world space of the file
    double time = 0;          // seconds of the scene's animations; a scene without any ignores it
};

/// The scene as the state has it, its camera included.
Moment moment_of(const RenderedState& state);

enum class ShownPanel { vulkan, cpu, split, difference };
enum class ShownLayer {
    radiance,
    albedo,
    normal,
    depth,
    standard_error,
    samples,
    light_id,
    reservoir_confidence,  // M
    reservoir_weight,      // W
    nonfinite,
};

/// How what was rendered is shown: no change of it costs a sample.
struct ShownState {
    ShownPanel panel = ShownPanel::cpu;
    ShownLayer layer = ShownLayer::radiance;
    double divider = 0.5;  // of a split: share of the width that the left panel, the CPU's, takes
    double exposure = 0;   // EV
    ToneMap tonemap = default_tonemap;
    double layer_scale = 0;  // what a layer of numbers shows as full; 0 finds one
};

struct AnimationState {
    bool playing = false;
    double speed = 1;     // seconds of the scene a second
    double duration = 0;  // seconds; 0 where nothing moves. It plays round and round
};

/// What the interface reads and writes.
struct ViewState {
    RenderedState rendered;
    ShownState shown;
    AnimationState animation;
    bool follows_camera =
        true;                  // the scene's own camera, where an animation moves it; an input to the camera ends that
    glm::dvec3 pivot{0};       // that the camera orbits about
    bool interacting = false;  // changes keep coming (a drag, a key held, a slider held): previews, not full pictures
    double frames_per_second = 60;
    bool paused = false;  // no samples are taken: minimised
    bool keeps_hidden =
        false;  // panels that are not shown follow the state too, without samples: paths are replayed on both
};

/// What a worker is given: the newest counts, those before are forgotten.
struct ViewJob {
    std::shared_ptr<const Scene> scene;  // as loaded: without the state's sun, pose, camera
    RenderedState state;
    std::uint64_t version = 0;  // rises from job to job
    bool moving = false;        // others will follow at once
    bool paused = false;
    double frame_seconds = 1.0 / 60;
};

}  // namespace diptych::core::app
