// Chains of frames, and whether each frame of them is unbiased.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pack/packed_scene.h"
#include "render/renderer.h"

namespace diptych::core::tests {

using MakeRenderer = std::function<std::unique_ptr<Renderer>(const PackedScene&)>;

/// What a chain is of. `seconds` 0: nothing moves; else frame f shows the scene at start + f * seconds.
struct ChainCase {
    std::string name;
    Scene scene;
    RenderSettings settings;  // integrator, depth, resampling; size and atlas are the harness's
    double start = 0;
    double seconds = 0;
    double orbit = 0;  // degrees a frame that the camera turns by
};

struct ChainSize {
    std::uint32_t tile = 16;   // side of each copy of the view, pixels
    std::uint32_t copies = 8;  // a row and a column; each copy is one chain
};

/// Mean scattered radiance of every chain at each of `frames`, in order: an atlas of isolated copies of the view, so
/// that every chain has its own random numbers (the unit of analysis is a chain). Emission seen directly is taken off,
/// by a render of depth 0 with the same camera rays: it is the same in every integrator, and its noise would drown what
/// is tested.
std::vector<std::vector<double>> run_chains(const ChainCase& c, const ChainSize& size,
                                            const std::vector<std::uint32_t>& frames, const MakeRenderer& make,
                                            std::uint32_t seed);

/// What `path` gives for the same picture at frame `frame`: the means of `runs` renders.
std::vector<double> run_reference(const ChainCase& c, const ChainSize& size, std::uint32_t frame, std::uint32_t runs,
                                  std::uint32_t spp, const MakeRenderer& make);

/// Difference of two means in standard errors, in per cent of the second mean, and the half-width of its 95 % interval.
struct Difference {
    double z = 0;
    double percent = 0;
    double half_width = 0;
};

Difference difference(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace diptych::core::tests
