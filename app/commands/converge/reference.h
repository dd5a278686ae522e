// The picture that errors are measured against, and how well it is known itself.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "commands/converge/plan.h"
#include "commands/converge/state.h"
#include "image/layered_image.h"
#include "scene/scene.h"

namespace diptych::app {

struct Reference {
    LayeredImage image;           // with standard errors, where they are known
    std::vector<float> variance;  // of every value: standard error squared; zeros where unknown
    std::vector<float> weights;   // 1 / (r² + 1e-2)
    bool variance_known = false;
    std::string method;     // a file, or what rendered it
    std::uint32_t spp = 0;  // 0: unknown
    std::string command;    // empty: unknown
};

/// Of the reference's noise: what it adds to the MSE and the relMSE of everything on average, and how far the actual
/// noise may be from that average. The second is sqrt(sum of 2 V²)/N over the pixels, V the variance of a pixel's mean
/// over its channels, as for normal noise.
struct ReferenceNoise {
    double mse = 0;
    double relmse = 0;
    double mse_error = 0;
    double relmse_error = 0;
    double mean = 0;  // of the reference itself, over pixels and channels
};
ReferenceNoise noise_of(const Reference& reference);

/// A file of the given size with three channels; its layer of standard errors is its variance. Throws Error.
Reference load_reference(const std::string& path, int width, int height);

/// Renders what is missing of it, `spp` samples a block, and leaves reference.exr in the folder; a finished one is read
/// back. Nothing where `cancel` came in between: the blocks so far are kept. Throws Error.
std::optional<Reference> make_reference(const Scene& scene, const Method& method, std::uint32_t spp,
                                        ConvergeState& state, const std::atomic<bool>& cancel,
                                        const std::function<void(std::uint32_t)>& begin_block);

}  // namespace diptych::app
