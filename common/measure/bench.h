// How fast a backend renders a scene, integrator by integrator.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "measure/open_session.h"
#include "measure/step_hook.h"

namespace diptych::core {

struct BenchSettings {
    std::vector<Integrator> integrators;
    std::uint32_t spp = 1;  // samples a pixel in one frame
    int frames = 9;         // of which the median counts
};

/// The rays of a frame traced once more, and nothing else.
struct BareTraversal {
    double rays_per_second = 0;
    double share = 0;  // of the seconds that the integrator takes for the same rays
};

struct IntegratorBench {
    Integrator integrator = Integrator::path;
    double milliseconds = 0;  // one sample a pixel
    double samples_per_second = 0;
    double rays_per_second = 0;
    std::optional<BareTraversal> bare;            // of integrators that take each sample by itself
    std::optional<double> cost_relative_to_brdf;  // a sample; where brdf was measured
    std::vector<PassTime> passes;                 // a sample's
    RendererCosts costs;
};

struct BenchResult {
    std::string backend;
    std::string device;
    int frames = 0;  // of each integrator; fewer than asked for where `cancel` came in between
    std::vector<IntegratorBench> integrators;  // as the settings list them
};

/// Times that `begin` is called.
int bench_steps(const BenchSettings& settings);

/// Medians over the frames. Each integrator has a session of its own, and they take turns, so that all ratios come from
/// the same conditions; restir's frames follow one another. The integrators are the settings', of which there is at
/// least one, not the request's. Nothing where `cancel` came before every integrator had a frame. Throws NoDevice and
/// Error.
std::optional<BenchResult> bench_integrators(const BenchSettings& settings, const Scene& scene,
                                             const RenderRequest& request, const OpenSession& open,
                                             const std::atomic<bool>& cancel, const StepHook& begin);

}  // namespace diptych::core
