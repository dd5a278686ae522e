// Every path of a picture on two backends, from the same random numbers.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "image/image.h"
#include "measure/path_agreement.h"
#include "render/session.h"

namespace diptych::core {

struct PairedRun {
    Integrator integrator = Integrator::path;
    PairedReport report;
    std::vector<std::string> devices;
    Image differing;  // one channel: the share of each pixel's paths that part or drift
};

/// Samples 0 to spp-1 of every pixel, or as many of them as there were when `cancel` was set. Both sessions are of one
/// scene at rest under the same settings. Throws Error where a backend keeps no record of its paths.
PairedRun compare_all_paths(Session& a, Session& b, std::uint32_t spp, const std::atomic<bool>& cancel);

}  // namespace diptych::core
