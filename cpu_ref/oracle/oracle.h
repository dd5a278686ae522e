// The independent renderer: double precision, textbook path tracing, docs/integrand.md and nothing of the shared
// headers.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "oracle/exact_sum.h"
#include "oracle/path.h"

namespace diptych::core {

struct OracleSettings {
    int width = 64;
    int height = 64;
    unsigned max_depth = 8;  // scattering events
    std::uint64_t seed = 0;
    oracle::Mode mode = oracle::Mode::mis;
    oracle::Distribution distribution = oracle::Distribution::ggx;
    oracle::NormalMaps normal_maps = oracle::NormalMaps::shading;
    int camera = 0;         // index into the scene's cameras
    bool by_depth = false;  // keep OracleImage::depths
};

/// Sums over one pixel's samples. A sample that is not finite, or negative, adds to `nonfinite` alone; its first hit
/// counts.
struct OraclePixel {
    /// First hits in these units, so that their sums are exact.
    static constexpr double fixed_unit = 0x1p-28;

    oracle::ExactSum<3, 3> sum;
    oracle::ExactSum<3, 3, 2> squares;
    std::array<std::int64_t, 3> albedo{};  // over all samples: base colour,
    std::array<std::int64_t, 3> normal{};  // shading normal,
    oracle::ExactSum<1, 2> depth;                  // and distance from the ray's start, of the first hit; a miss adds nothing
    std::uint64_t samples = 0;
    std::uint64_t nonfinite = 0;
    std::uint64_t rays = 0;

    glm::dvec3 mean() const;
    glm::dvec3 variance_of_mean() const;  // from two samples on
    glm::dvec3 mean_albedo() const;
    glm::dvec3 mean_normal() const;
    double mean_depth() const;
};

/// What light that was scattered so many times adds: sums over one pixel's samples.
struct OracleDepth {
    glm::dvec3 sum{0};
    glm::dvec3 sum_squares{0};
};

/// Row-major from the top.
struct OracleImage {
    std::vector<OraclePixel> pixels;
    std::vector<OracleDepth> depths;  // max_depth + 1 a pixel, where asked for
};

class Oracle {
public:
    /// Keeps a reference to the scene, which must outlive it. `threads` 0 is one a core. Throws Error where the
    /// settings do not fit the scene.
    Oracle(const Scene& scene, const OracleSettings& settings, int threads = 0);
    ~Oracle();

    /// Adds samples first .. first+count-1 to every pixel; a sample is the same whatever was asked for before, and on
    /// any number of threads. Ends early, within about 0.1 s, once `cancel` is set; each pixel's own count stays right.
    void render(std::uint64_t first, std::uint64_t count, const std::atomic<bool>& cancel);

    /// Empties the image and goes on with another seed.
    void restart(std::uint32_t seed);

    const OracleImage& image() const;
    /// Of triangles, sums and Embree's structures, and of those alone.
    std::uint64_t bytes() const;
    std::uint64_t acceleration_bytes() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diptych::core
