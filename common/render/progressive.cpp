#include "render/progressive.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clock.h"
#include "error.h"
#include "render/film_statistics.h"
#include "render/merge_films.h"

namespace diptych::core {

namespace {

constexpr double batch_seconds = 0.25;
constexpr std::uint32_t largest_batch = 4096;
constexpr std::uint32_t largest_growth = 4;  // from batch to batch: the first ones are too short to measure well
constexpr double look_interval = 1;
constexpr double look_share = 0.02;
// Of a time limit, left to the last batch. Those before it take half of what is left: then a machine that suddenly has
// half its speed is noticed in time.
constexpr double last_share = 0.02;

std::uint32_t next_batch(const ProgressiveTarget& target, std::uint32_t done, double seconds, std::uint32_t last_batch,
                         double last_seconds, std::uint64_t look_at) {
    std::uint64_t batch = 1;
    if (last_batch > 0) {
        const double sample_seconds = std::max(last_seconds / last_batch, 1e-9);
        double wanted = std::floor(batch_seconds / sample_seconds);
        if (target.seconds > 0) {
            const double left = (target.seconds - seconds) / sample_seconds;
            if (left < 0.5) {
                return 0;
            }
            const double last = last_share * target.seconds / sample_seconds;
            wanted = std::min(wanted, std::round(left <= last ? left : std::max(left / 2, last)));
        }
        const double ceiling = std::min<double>(largest_batch, static_cast<double>(last_batch) * largest_growth);
        batch = static_cast<std::uint64_t>(std::clamp(wanted, 1.0, ceiling));
    }
    const std::uint64_t limit =
        target.spp > 0 ? target.spp : std::numeric_limits<std::uint32_t>::max() - std::uint64_t{target.first};
    return static_cast<std::uint32_t>(std::min({batch, limit - done, look_at - done}));
}

/// The renderer's film with the samples that were taken before.
std::shared_ptr<const Film> whole_film(const Renderer& renderer, const Film* base) {
    if (base == nullptr) {
        return renderer.film_in_place();
    }
    const auto film = std::make_shared<Film>(renderer.film());
    merge_films(*base, *film);
    return film;
}

/// Looks at the film now and then: what only it knows costs a copy.
class FilmWatch {
public:
    explicit FilmWatch(const std::function<double()>& now) : now_(now), next_(now() + look_interval) {}

    void look(const Renderer& renderer, double base_rays, Progress& progress, const ProgressiveHooks& hooks) {
        const double begin = now_();
        if (begin < next_) {
            return;
        }
        const std::shared_ptr<const Film> kept = whole_film(renderer, hooks.base);
        const Film& film = *kept;
        progress.relmse = estimated_relmse(film);
        progress.rays_per_second = (static_cast<double>(film_totals(film).rays) - base_rays) / progress.seconds;
        if (hooks.film) {
            hooks.film(film);
        }
        const double end = now_();
        next_ = end + std::max(look_interval, (end - begin) / look_share);
    }

private:
    const std::function<double()>& now_;
    double next_;
};

/// Looks at the film where the error may have met its target.
class ErrorTarget {
public:
    ErrorTarget(double relmse, std::uint64_t look_at) : target_(relmse), look_at_(look_at) {}

    /// At which sample count; beyond any where there is no target.
    std::uint64_t look_at() const { return target_ > 0 ? look_at_ : std::numeric_limits<std::uint64_t>::max(); }

    bool met(const Renderer& renderer, const Film* base, std::uint32_t spp, Progress& progress) {
        if (spp < look_at()) {
            return false;
        }
        const std::optional<double> relmse = estimated_relmse(*whole_film(renderer, base));
        if (!relmse) {
            throw Error("the error has no estimate: no standard errors are kept");
        }
        progress.relmse = relmse;
        const double wanted = std::ceil(spp * *relmse / target_);
        needed_ = wanted;
        look_at_ = static_cast<std::uint64_t>(std::clamp(wanted, spp + 1.0, 2.0 * spp));
        return *relmse <= target_;
    }

    /// Samples in all, as the latest look has it.
    double needed() const { return target_ > 0 && needed_ > 0 ? needed_ : HUGE_VAL; }

private:
    double target_;
    double needed_ = 0;
    std::uint64_t look_at_;
};

}  // namespace

ProgressiveResult render_progressively(Renderer& renderer, const ProgressiveTarget& target,
                                       const std::atomic<bool>& cancel, const ProgressiveHooks& hooks) {
    const std::function<double()> now = hooks.now ? hooks.now : now_seconds;
    const auto [pixels, samples_before] = [&] {  // and no film, which may be as large as what is left of the memory
        const std::shared_ptr<const Film> film = renderer.film_in_place();
        return std::pair(film->pixels.size(), samples_of_every_pixel(*film));
    }();
    FilmWatch watch(now);
    ErrorTarget error(target.relmse, target.look_at);
    const std::uint32_t base_spp = hooks.base == nullptr ? 0 : samples_of_every_pixel(*hooks.base);
    const double base_rays = hooks.base == nullptr ? 0 : static_cast<double>(film_totals(*hooks.base).rays);
    ProgressiveResult result;
    std::uint32_t batch = 0;
    double last_seconds = 0;
    Progress progress;
    while (!cancel) {
        // A base of more samples than the next look wants is looked at after one more.
        const std::uint64_t look_at = std::max(error.look_at(), base_spp + result.spp + std::uint64_t{1}) - base_spp;
        batch = next_batch(target, result.spp, result.seconds, batch, last_seconds, look_at);
        if (batch == 0) {
            return result;
        }
        const double begin = now();
        if (hooks.render) {
            hooks.render(target.first + result.spp, batch, cancel);
        } else {
            renderer.render(target.first + result.spp, batch, cancel);
        }
        last_seconds = now() - begin;
        result.seconds += last_seconds;
        if (cancel) {
            break;
        }
        result.spp += batch;
        result.target_met = error.met(renderer, hooks.base, base_spp + result.spp, progress);
        result.look_at = error.look_at();
        if (hooks.progress) {
            const double sample_seconds = std::max(result.seconds / result.spp, 1e-12);
            const double until_spp = target.spp > 0 ? (target.spp - result.spp) * sample_seconds : HUGE_VAL;
            const double until_time = target.seconds > 0 ? std::max(0.0, target.seconds - result.seconds) : HUGE_VAL;
            progress.spp = base_spp + result.spp;
            progress.seconds = result.seconds;
            const double until_error = std::max(0.0, (error.needed() - progress.spp) * sample_seconds);
            progress.eta_seconds = std::min({until_spp, until_time, until_error});
            progress.samples_per_second = static_cast<double>(pixels) / sample_seconds;
            watch.look(renderer, base_rays, progress, hooks);
            hooks.progress(progress);
        }
        if (result.target_met) {
            return result;
        }
    }
    result.spp = samples_of_every_pixel(*renderer.film_in_place()) - samples_before;
    result.interrupted = target.spp == 0 || result.spp < target.spp;
    return result;
}

ProgressiveResult render_progressively(Session& session, const ProgressiveTarget& target,
                                       const std::atomic<bool>& cancel, ProgressiveHooks hooks) {
    hooks.render = [&session](std::uint32_t first, std::uint32_t count, const std::atomic<bool>& stop) {
        session.render(first, count, stop);
    };
    return render_progressively(session.renderer(), target, cancel, hooks);
}

}  // namespace diptych::core
