// Are two renderings the same? Statistically, as pictures, or path by path.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "diptych/film.h"
#include "diptych/scene.h"
#include "diptych/session.h"
#include "diptych/settings.h"

DIPTYCH_BEGIN

/// One side of a comparison.
struct Side {
    Backend backend = Backend::cpu;
    Integrator integrator = Integrator::path;  // the oracle heeds none
};

struct VerifyOptions {
    Side a;
    Side b;                          // the reference
    std::uint32_t runs = 32;         // a side, each with a seed of its own; at least 3
    std::uint32_t spp = 64;          // samples a pixel of each run
    Settings settings;               // but for the integrator; all runs' seeds derive from the seed
    double alpha = 1e-3;             // chance that unbiased sides FAIL
    double max_half_width = 0.1;     // percent of the image mean: a PASS needs a 95 % interval as narrow
    double max_tile_half_width = 1;  // percent of a tile's mean: and half of the tiles' as narrow
    int tile = 16;                   // pixels a side
    std::string device;              // vulkan
    int threads = 0;
    std::stop_token stop;
    /// Called before each run, from any thread, by one at a time.
    std::function<void(std::uint32_t run, std::uint32_t runs)> progress;
};

enum class VerdictKind { pass, fail, inconclusive };

/// What is known of the difference of two sides' expectations. docs/verification.md defines the tests.
struct Verdict {
    VerdictKind verdict = VerdictKind::inconclusive;
    std::string reason;                 // one clause
    double bias_percent = 0;            // (a - b) / b, of the image mean of luminance
    double ci95 = 0;                    // half width of its 95 % confidence interval, percent
    double p = 1;                       // least of the tests, adjusted for their number: FAIL at alpha or less
    double min_detectable_percent = 0;  // bias of the image mean that would be found with 90 % power
    int tiles_x = 0;
    int tiles_y = 0;
    std::vector<double> p_values;  // tiles_y * tiles_x, row-major; NaN where nothing varies and the sides agree, 0
                                   // where such sides differ
};

/// Renders both sides and tests whether they converge to the same image. Throws Interrupted where stopped, NoDevice and
/// Error.
DIPTYCH_EXPORT Verdict verify(const Scene& scene, const VerifyOptions& options);

/// How far picture a is from the reference b. NaN means unknown.
struct Comparison {
    double mse = std::numeric_limits<double>::quiet_NaN();     // mean (a-b)²
    double relmse = std::numeric_limits<double>::quiet_NaN();  // mean (a-b)² / (b² + 0.01)
    std::array<double, 3> mean_ratio{};                        // mean(a) / mean(b), a channel
    std::array<double, 3> z{};  // difference of the means over its standard error; needs independent pictures
    double fraction_equal = 0;  // pixels that agree to 0.1 %
    std::size_t nonfinite = 0;  // pixels left out
};

/// Throws Error where the sizes differ.
DIPTYCH_EXPORT Comparison compare(const Film& a, const Film& b);
/// Of files: EXR, or any picture; "FILE:LAYER" names a layer of an EXR.
DIPTYCH_EXPORT Comparison compare(const std::string& a, const std::string& b);

struct ReplayOptions {
    std::array<int, 2> pixel{};  // x, y; from the top left
    std::uint32_t sample = 0;
    double tolerance = 1e-3;  // relative: smaller differences are rounding
};

struct ReplayVertex {
    Point position{};   // where the ray ended, world space of the file
    Vec3 emission{};    // that it adds to the path's radiance, throughput and MIS weight included
    Vec3 throughput{};  // of what comes after
};

struct ReplayResult {
    std::array<Vec3, 2> radiance{};  // of the whole path in both sessions
    std::array<std::vector<ReplayVertex>, 2> vertices;
    std::optional<std::size_t> parts_at;  // vertex from which the two paths differ
    std::string text;                     // "They part at vertex 2: …" in one line
};

/// Traces one path in both sessions, from the same random numbers, and finds where they part. Films stay as they are.
/// Throws Error where a backend keeps no record of its paths (Capabilities::replay) or the sessions differ in settings.
DIPTYCH_EXPORT ReplayResult replay(Session& a, Session& b, const ReplayOptions& options);

DIPTYCH_END
