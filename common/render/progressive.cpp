#include "render/progressive.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "render/film_statistics.h"

namespace diptych {

namespace {

constexpr double batch_seconds = 0.25;
constexpr std::uint32_t largest_batch = 4096;
constexpr std::uint32_t largest_growth = 4;  // from batch to batch: the first ones are too short to measure well
constexpr double look_interval = 1;
constexpr double look_share = 0.02;

double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::uint32_t next_batch(const ProgressiveTarget& target, std::uint32_t done, double seconds, std::uint32_t last_batch,
                         double last_seconds) {
    std::uint64_t batch = 1;
    if (last_batch > 0) {
        const double sample_seconds = std::max(last_seconds / last_batch, 1e-9);
        double wanted = std::floor(batch_seconds / sample_seconds);
        if (target.seconds > 0) {
            const double left = (target.seconds - seconds) / sample_seconds;
            if (left < 0.5) {
                return 0;
            }
            wanted = std::min(wanted, std::round(left));
        }
        const double ceiling = std::min<double>(largest_batch, static_cast<double>(last_batch) * largest_growth);
        batch = static_cast<std::uint64_t>(std::clamp(wanted, 1.0, ceiling));
    }
    const std::uint64_t limit =
        target.spp > 0 ? target.spp : std::numeric_limits<std::uint32_t>::max() - std::uint64_t{target.first};
    return static_cast<std::uint32_t>(std::min(batch, limit - done));
}

std::uint32_t samples_of_every_pixel(const Film& film) {
    std::uint32_t least = film.pixels.empty() ? 0 : std::numeric_limits<std::uint32_t>::max();
    for (const shared::FilmPixel& pixel : film.pixels) {
        least = std::min(least, pixel.samples + pixel.nonfinite);
    }
    return least;
}

/// Looks at the film now and then: what only it knows costs a copy.
class FilmWatch {
public:
    explicit FilmWatch(const std::function<double()>& now) : now_(now), next_(now() + look_interval) {}

    void look(const Renderer& renderer, Progress& progress) {
        const double begin = now_();
        if (begin < next_) {
            return;
        }
        const Film film = renderer.film();
        progress.relmse = estimated_relmse(film);
        progress.rays_per_second = static_cast<double>(film_totals(film).rays) / progress.seconds;
        const double end = now_();
        next_ = end + std::max(look_interval, (end - begin) / look_share);
    }

private:
    const std::function<double()>& now_;
    double next_;
};

}  // namespace

ProgressiveResult render_progressively(Renderer& renderer, const ProgressiveTarget& target,
                                       const std::atomic<bool>& cancel, const ProgressiveHooks& hooks) {
    const std::function<double()> now = hooks.now ? hooks.now : steady_seconds;
    const Film before = renderer.film();
    FilmWatch watch(now);
    ProgressiveResult result;
    std::uint32_t batch = 0;
    double last_seconds = 0;
    Progress progress;
    while (!cancel) {
        batch = next_batch(target, result.spp, result.seconds, batch, last_seconds);
        if (batch == 0) {
            return result;
        }
        const double begin = now();
        renderer.render(target.first + result.spp, batch, cancel);
        last_seconds = now() - begin;
        result.seconds += last_seconds;
        if (cancel) {
            break;
        }
        result.spp += batch;
        if (hooks.progress) {
            const double sample_seconds = std::max(result.seconds / result.spp, 1e-12);
            const double until_spp = target.spp > 0 ? (target.spp - result.spp) * sample_seconds : HUGE_VAL;
            const double until_time = target.seconds > 0 ? std::max(0.0, target.seconds - result.seconds) : HUGE_VAL;
            progress.spp = result.spp;
            progress.seconds = result.seconds;
            progress.eta_seconds = std::min(until_spp, until_time);
            progress.samples_per_second = static_cast<double>(before.pixels.size()) / sample_seconds;
            watch.look(renderer, progress);
            hooks.progress(progress);
        }
    }
    result.spp = samples_of_every_pixel(renderer.film()) - samples_of_every_pixel(before);
    result.interrupted = target.spp == 0 || result.spp < target.spp;
    return result;
}

}  // namespace diptych
