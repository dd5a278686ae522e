// Everything that a user asks of a render, backend and files included.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "image/tonemap_image.h"
#include "render/sample_ranges.h"
#include "settings/settings.h"
#include "scene/sun.h"
#include "scene/viewpoint.h"

namespace diptych::core {

/// Environments by name.
inline constexpr const char* no_environment = "none";
inline constexpr const char* neutral_environment = "neutral";

struct RenderRequest {
    std::string scene;                            // file
    std::vector<std::string> ignored_extensions;  // required by the file, lacking here, and done without
    bool strict = false;                          // refuse a file that loads with a warning
    bool allow_external = false;                  // read what the file names outside its folder too
    std::uint64_t memory_limit = 0;               // bytes that a file may ask for; 0: a quarter of the memory
    std::string clip;                             // name or index of the animation to play; empty is all
    std::string output;                           // file
    std::string backend = "cpu";                  // cpu, vulkan or oracle
    std::string oracle_mode = "mis";              // oracle: mis, bsdf, hemisphere or area
    std::string device;                           // vulkan: index or name; empty is the best
    std::string camera;                           // name or index; empty is the first
    std::string environment;                      // none, neutral, "R,G,B" or a file; empty: as the scene needs
    bool adds_neutral_sky = false;                // what an empty environment came to
    double environment_scale = 1;
    double environment_rotation = 0;       // degrees
    LensChoice lens;                       // of the camera
    Viewpoint viewpoint;                   // of the camera; empty is the scene's own
    std::optional<Sun> sun;                // beside the scene's own lights
    double exposure = 0;                   // EV, for output that is tone mapped
    std::string tonemap = tonemap_name(default_tonemap);
    int threads = 0;  // cpu, oracle; 0 is one a core
    bool validation = false;
    bool group_instances = true;  // vulkan; off to measure what it gains
    std::uint32_t spp = 64;       // 0 where `seconds` is the limit
    std::optional<SampleRange> samples;  // a part of the picture: these alone, `spp` is how many
    bool sums = false;                   // keep the film's sums in the file, so that it can be merged or resumed
    double seconds = 0;
    double target_error = 0;   // relMSE at which to stop, as the film's standard errors have it; 0 is none
    std::uint32_t frames = 0;  // of a sequence; 0 is one picture of the scene at rest
    std::uint32_t frame = 0;   // which of them this is, for what a picture says of itself
    double fps = 24;
    double start = 0;           // seconds, of the first frame, kept or not
    std::uint32_t warm_up = 0;  // frames before the first that is kept; of one picture at rest: samples
    double orbit = 0;           // degrees a frame that the camera turns: degrees * fps * time in all
    RenderSettings settings;
};

/// RenderRequest::environment of the picture, with a sky that was added; empty where the scene lights itself.
inline std::string used_environment(const RenderRequest& request) {
    return request.adds_neutral_sky ? neutral_environment : request.environment;
}

/// Seconds of the scene's animations at which the request's first kept frame stands.
inline double shown_at(const RenderRequest& request) {
    return request.start + request.warm_up / request.fps;
}

}  // namespace diptych::core
