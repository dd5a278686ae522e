// How fast does a backend render a scene?
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "diptych/scene.h"
#include "diptych/settings.h"

DIPTYCH_BEGIN

struct BenchOptions {
    std::vector<Integrator> integrators{Integrator::brdf, Integrator::direct, Integrator::path};
    std::uint32_t spp = 1;  // samples a pixel of one frame
    int frames = 9;         // of each integrator, of which the median counts; at least 5
    BackendChoice backend;  // cpu or vulkan
    Settings settings;      // but for the integrator; no layers are kept
    std::stop_token stop;
    /// Called before each step, with what it is to do ("path, frame 2") and how many of the steps are done.
    std::function<void(const std::string& step, int done, int steps)> progress;
};

struct PassTime {
    std::string pass;
    double milliseconds = 0;  // one sample a pixel
};

struct IntegratorBench {
    Integrator integrator = Integrator::path;
    double milliseconds = 0;  // one sample a pixel
    double samples_per_second = 0;
    double rays_per_second = 0;
    /// The same rays traced once more and nothing else, and the share that this takes of the integrator's time: near 1,
    /// traversal limits the integrator, and shading otherwise. None for ris and restir.
    std::optional<double> bare_rays_per_second;
    std::optional<double> share_of_bare;
    std::optional<double> cost_relative_to_brdf;  // of a sample; none where brdf was not measured
    double build_seconds = 0;                     // of acceleration structures
    double compile_seconds = 0;                   // of pipelines
    std::vector<PassTime> passes;
    std::uint64_t bytes = 0;  // on the device
};

struct BenchResult {
    std::string backend;
    std::string device;
    int frames = 0;  // of each integrator; fewer than asked for where it was stopped
    std::vector<IntegratorBench> integrators;
    std::string text;  // a table for people, as the program's `bench` prints it
};

/// Medians over frames, for which the integrators take turns, so that all ratios come from the same conditions. Throws
/// Interrupted where it was stopped before every integrator had a frame; SettingError, NoDevice and Error.
DIPTYCH_EXPORT BenchResult bench(const Scene& scene, const BenchOptions& options = {});

DIPTYCH_END
