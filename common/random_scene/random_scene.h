// Small scenes drawn at random from everything that the renderer accepts.
#pragma once

#include <cstdint>

#include "settings/settings.h"
#include "scene/scene.h"

namespace diptych::core {

/// The environment and the lens are part of the scene, though no glTF file holds them.
struct RandomScene {
    std::uint64_t seed = 0;
    Scene scene;
    RenderSettings settings;  // with the camera; the integrator is what a picture of it shows
    double sky_degrees = 0;   // that the environment is turned by, as the command line says it
    std::uint32_t frames = 0;  // of the sequence that is judged, from 0 s on; 0: the scene at rest
};

/// Of a scene that moves.
inline constexpr std::uint32_t random_frames = 5;
inline constexpr double random_fps = 8;

/// A pure function of the seed. Every surface is lit by large or distant light and nothing narrow reflects a small
/// one, so that a mean is known to 1 % after some 10^5 samples.
RandomScene make_random_scene(std::uint64_t seed);

/// The same scene, in which nodes, cameras and lights move and switch over random_frames frames. At rest it is
/// make_random_scene's.
RandomScene make_moving_random_scene(std::uint64_t seed);

}  // namespace diptych::core
