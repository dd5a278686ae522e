// The loop that lets a picture grow, until it is good enough, time is up, or someone asks to stop.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>

#include "render/renderer.h"
#include "render/session.h"

namespace diptych::core {

/// Before this many samples no estimate of the error is believed: a few equal samples would seem to be exact.
inline constexpr std::uint32_t least_judged_samples = 16;

/// When to stop: at the first of the limits; at least one of them is set.
struct ProgressiveTarget {
    std::uint32_t first = 0;  // index of the first sample
    std::uint32_t spp = 0;    // samples a pixel; 0 is no limit
    double seconds = 0;       // of rendering, to the nearest whole sample; 0 is no limit
    double relmse = 0;        // as estimated from the film's standard errors; 0 is no limit
    std::uint64_t look_at = least_judged_samples;  // relmse: at how many samples the estimate is asked for first
};

struct Progress {
    std::uint32_t spp = 0;          // done, of every pixel, those of the base among them
    double seconds = 0;             // of rendering so far
    double eta_seconds = 0;         // until the first limit; infinite while that is not known
    double samples_per_second = 0;  // over all pixels
    double rays_per_second = 0;     // as of the latest look at the film; 0 before it
    std::optional<double> relmse;   // estimate, as of the latest look
};

struct ProgressiveHooks {
    const Film* base = nullptr;  // even, of samples taken before: counted in by hooks and estimates, but by no limit
    std::function<void(const Progress&)> progress;  // after every batch
    std::function<void(const Film&)> film;          // what has grown, at every look
    // Takes the samples; the renderer's own by default.
    std::function<void(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel)> render;
    std::function<double()> now;                    // seconds, for tests; the steady clock by default
};

struct ProgressiveResult {
    std::uint32_t spp = 0;  // samples that every pixel has been given
    double seconds = 0;     // spent rendering
    bool interrupted = false;
    bool target_met = false;  // relmse: its estimate is at or below it
    std::uint64_t look_at = 0;  // relmse: at how many samples the estimate is to be asked for next
};

/// Renders in batches of about a quarter of a second, shorter towards the end of a time, sized by the speed of the one
/// before, until the target is met or `cancel` is set. The film is looked at between batches, at most once a second and
/// for at most a fiftieth of the time, and only where there is a progress hook. Whether the error's target is met is
/// looked at after 16 samples and then where the estimate, which falls as 1/N, is to meet it, at twice the samples at
/// the latest; these counts depend on the samples alone, so the same seed stops at the same count on a machine of any
/// speed, and a render that goes on from `base` with the look_at of that render's result at the count of one that was
/// never interrupted. Throws Error where the film keeps no moments for it. A batch that `cancel` cut short leaves extra samples on
/// some pixels; they do not count in `spp`.
ProgressiveResult render_progressively(Renderer& renderer, const ProgressiveTarget& target,
                                       const std::atomic<bool>& cancel, const ProgressiveHooks& hooks = {});

/// The session's picture; target.first counts from its first sample.
ProgressiveResult render_progressively(Session& session, const ProgressiveTarget& target,
                                       const std::atomic<bool>& cancel, ProgressiveHooks hooks = {});

}  // namespace diptych::core
