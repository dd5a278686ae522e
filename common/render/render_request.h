// Everything that a user asks of a render, backend and files included.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/settings.h"

namespace diptych {

struct RenderRequest {
    std::string scene;   // file
    std::vector<std::string> ignored_extensions;  // required by the file, lacking here, and done without
    std::string output;  // file
    std::string backend = "cpu";       // cpu, vulkan or oracle
    std::string oracle_mode = "bsdf";  // oracle: bsdf, hemisphere or area
    std::string device;       // vulkan: index or name; empty is the best
    std::string camera;       // name or index; empty is the first
    std::string environment;  // "R,G,B" or a file; empty is the scene's own
    double environment_scale = 1;
    double environment_rotation = 0;       // degrees
    std::optional<double> lens_radius;     // metres
    std::optional<double> focus_distance;  // metres
    double exposure = 0;                   // EV, for output that is tone mapped
    std::string tonemap = "none";
    int threads = 0;  // cpu, oracle; 0 is one a core
    bool validation = false;
    std::uint32_t spp = 64;  // 0 where `seconds` is the limit
    double seconds = 0;
    RenderSettings settings;
};

}  // namespace diptych
