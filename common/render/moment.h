// What may change of a scene from one picture to the next without its being another scene.
#pragma once

#include <optional>

#include "settings/settings.h"
#include "scene/scene.h"
#include "scene/sun.h"

namespace diptych::core {

struct Orbit {
    glm::dvec3 pivot{0};  // world space of the file, metres; see orbit_pivot
    double degrees = 0;   // counter-clockwise from above
};

struct Moment {
    std::optional<double> seconds;    // of the animations that play; none: at rest
    std::optional<Camera> camera;     // in the place of the one that is seen through; world space of the file
    std::optional<Orbit> orbit;       // turns that camera, wherever it then stands
    double environment_scale = 1;     // factor on the scene's own radiance
    double environment_rotation = 0;  // degrees about +Y, on top of the scene's own
    std::optional<Sun> sun;           // beside the scene's own lights
};

/// Whether it scales or turns the environment.
bool changes_environment(const Moment& moment);

/// Brings `scene`, a copy of `loaded` that may stand at another moment, to this one. `camera` is the index of the one
/// that is seen through. What a moment without seconds would put at rest must stand there already. Throws Error where
/// there is no environment to change, and as pose_scene does.
void put_moment(const Scene& loaded, const Moment& moment, int camera, Scene& scene);

/// Its part that concerns environment and sun; `scene` may be `loaded` itself.
void put_lights(const Scene& loaded, const Moment& moment, Scene& scene);

/// What becomes invalid between two states of one scene: the least that brings a renderer from one to the other.
enum class Change {
    nothing,
    picture,   // the film, for another seed
    view,      // the camera as well
    moment,    // all that moves
    settings,  // arrays and pipelines that depend on settings, on the kind of camera or on which lights there are
    scene,     // all
};

/// Never `scene`.
Change change_between(const Moment& before, const RenderSettings& settings_before, const Moment& after,
                      const RenderSettings& settings_after);

/// But for the seed.
bool same_settings(const RenderSettings& a, const RenderSettings& b);

}  // namespace diptych::core
