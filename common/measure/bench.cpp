#include "measure/bench.h"

#include <fmt/format.h>

#include "clock.h"
#include "settings/names.h"
#include "stats/convergence.h"

namespace diptych::core {

namespace {

// Frames that do not count: two at least, since restir's first has none before it to reuse, and as many as a device
// needs to leave its clocks of rest.
constexpr std::uint32_t least_warm_up = 2;
constexpr std::uint32_t most_warm_up = 1024;
constexpr double warm_up_seconds = 0.5;

/// One integrator on its own renderer, and the times of its frames.
struct Entry {
    Entry(Integrator wanted, Session opened) : integrator(wanted), session(std::move(opened)) {}

    Integrator integrator;
    Session session;
    std::vector<double> frame_seconds;
    std::optional<TraversalBench> traversal;
    std::vector<std::vector<double>> pass_seconds;  // of each pass, its frames
    FilmTotals before;  // of the frames that count
    double rays_per_frame = 0;
    std::uint32_t next_frame = 0;
};

void measure(Entry& entry, std::uint32_t spp, const std::atomic<bool>& cancel) {
    const double before = entry.session.renderer().device_seconds();
    const std::vector<PassTime> passes_before = entry.session.renderer().pass_times();
    entry.session.render(entry.next_frame++ * spp, spp, cancel);
    entry.frame_seconds.push_back(entry.session.renderer().device_seconds() - before);
    const std::vector<PassTime> passes = entry.session.renderer().pass_times();
    entry.pass_seconds.resize(passes.size());
    for (std::size_t i = 0; i < passes.size(); ++i) {
        entry.pass_seconds[i].push_back(passes[i].seconds - passes_before[i].seconds);
    }
}

/// A frame's rays, by those of the samples since `before`: a frame that was cut short counts by its samples.
double rays_per_frame(const Entry& entry, std::uint32_t spp) {
    const RenderSettings& settings = entry.session.settings();
    const FilmTotals now = film_totals(entry.session.film());
    const double samples = static_cast<double>(now.samples + now.nonfinite) -
                           static_cast<double>(entry.before.samples + entry.before.nonfinite);
    const double rays = static_cast<double>(now.rays - entry.before.rays);
    return rays / samples * settings.width * settings.height * spp;
}

void warm_up(Entry& entry, std::uint32_t spp, const std::atomic<bool>& cancel) {
    const Stopwatch watch;
    while (!cancel && (entry.next_frame < least_warm_up ||
                       (entry.next_frame < most_warm_up && watch.seconds() < warm_up_seconds))) {
        measure(entry, spp, cancel);
    }
    entry.frame_seconds.clear();
    entry.pass_seconds.clear();
}

/// A sample's, each the median over the frames.
std::vector<PassTime> median_passes(const Entry& entry, std::uint32_t spp) {
    std::vector<PassTime> passes = entry.session.renderer().pass_times();
    for (std::size_t i = 0; i < passes.size(); ++i) {
        passes[i].seconds = median(entry.pass_seconds[i]) / spp;
    }
    return passes;
}

IntegratorBench evaluate(const Entry& entry, std::uint32_t spp, double brdf_seconds) {
    const RenderSettings& settings = entry.session.settings();
    const double pixels = static_cast<double>(settings.width) * settings.height;
    const double seconds = median(entry.frame_seconds);
    IntegratorBench bench;
    bench.integrator = entry.integrator;
    bench.milliseconds = 1000 * seconds / spp;
    bench.samples_per_second = pixels * spp / seconds;
    bench.rays_per_second = entry.rays_per_frame / seconds;
    if (entry.traversal) {
        bench.bare = {static_cast<double>(entry.traversal->rays) / entry.traversal->bare_seconds,
                      entry.traversal->bare_seconds / entry.traversal->integrator_seconds};
    }
    if (brdf_seconds > 0) {
        bench.cost_relative_to_brdf = seconds / brdf_seconds;
    }
    bench.passes = median_passes(entry, spp);
    bench.costs = entry.session.renderer().costs();
    return bench;
}

class Bench {
public:
    Bench(const BenchSettings& settings, const std::atomic<bool>& cancel, const StepHook& begin)
        : settings_(settings), cancel_(cancel), begin_(begin) {}

    /// As those below, false where the cancel came in between.
    bool build(const Scene& scene, RenderRequest request, const OpenSession& open) {
        request.settings.sample_count = settings_.spp * (most_warm_up + static_cast<std::uint32_t>(settings_.frames));
        for (const Integrator integrator : settings_.integrators) {
            begin_(fmt::format("{}, building", name_of(integrator)));
            request.settings.integrator = integrator;
            entries_.emplace_back(integrator, open(scene, request, false));
            if (cancel_) {
                return false;
            }
        }
        return true;
    }

    bool render_frames() {
        for (Entry& entry : entries_) {
            begin_(fmt::format("{}, warming up", name_of(entry.integrator)));
            warm_up(entry, settings_.spp, cancel_);
            if (cancel_) {
                return false;
            }
            entry.before = film_totals(entry.session.film());
        }
        while (frames_ < settings_.frames && render_round()) {
            ++frames_;
        }
        for (Entry& entry : entries_) {
            entry.frame_seconds.resize(static_cast<std::size_t>(frames_));
            for (std::vector<double>& seconds : entry.pass_seconds) {
                seconds.resize(static_cast<std::size_t>(frames_));
            }
            entry.rays_per_frame = frames_ > 0 ? rays_per_frame(entry, settings_.spp) : 0;
        }
        return frames_ == settings_.frames;
    }

    /// Frames that every integrator has rendered.
    int frames() const { return frames_; }

    bool trace_bare() {
        for (Entry& entry : entries_) {
            if (resamples(entry.integrator)) {
                continue;
            }
            begin_(fmt::format("{}, bare traversal", name_of(entry.integrator)));
            entry.traversal = entry.session.renderer().bench_traversal(settings_.spp);  // medians of its own repeats
            if (cancel_) {
                return false;
            }
        }
        return true;
    }

    BenchResult result() const {
        double brdf_seconds = 0;
        for (const Entry& entry : entries_) {
            if (entry.integrator == Integrator::brdf) {
                brdf_seconds = median(entry.frame_seconds);
            }
        }
        const Renderer& renderer = entries_.front().session.renderer();
        BenchResult result{renderer.backend(), renderer.device(), frames_, {}};
        for (const Entry& entry : entries_) {
            result.integrators.push_back(evaluate(entry, settings_.spp, brdf_seconds));
        }
        return result;
    }

private:
    bool render_round() {
        for (Entry& entry : entries_) {
            begin_(fmt::format("{}, frame {}", name_of(entry.integrator), frames_ + 1));
            measure(entry, settings_.spp, cancel_);
            if (cancel_) {
                return false;
            }
        }
        return true;
    }

    const BenchSettings& settings_;
    const std::atomic<bool>& cancel_;
    const StepHook& begin_;
    int frames_ = 0;
    std::vector<Entry> entries_;
};

}  // namespace

int bench_steps(const BenchSettings& settings) {
    int steps = 0;
    for (const Integrator integrator : settings.integrators) {
        const int building_and_warming_up = 2, bare_traversal = resamples(integrator) ? 0 : 1;
        steps += building_and_warming_up + settings.frames + bare_traversal;
    }
    return steps;
}

std::optional<BenchResult> bench_integrators(const BenchSettings& settings, const Scene& scene,
                                             const RenderRequest& request, const OpenSession& open,
                                             const std::atomic<bool>& cancel, const StepHook& begin) {
    Bench bench(settings, cancel, begin);
    const bool whole = bench.build(scene, request, open) && bench.render_frames() && bench.trace_bare();
    return whole || bench.frames() > 0 ? std::optional(bench.result()) : std::nullopt;
}

}  // namespace diptych::core
