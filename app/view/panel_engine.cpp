#include "view/panel_engine.h"

#include <algorithm>
#include <utility>

#include "clock.h"
#include "error.h"
#include "render/seeds.h"
#include "console/option_names.h"
#include "console/repeat_command.h"
#include "one_line.h"
#include "session/open_session.h"
#include "view/film_figures.h"
#include "view/renderer_on_device.h"
#include "view/view_request.h"

namespace diptych::core::app {

namespace {

constexpr double speed_share = 0.5;  // of the latest measurement in what is known

double blended(double known, double measured) {
    return known > 0 ? (1 - speed_share) * known + speed_share * measured : measured;
}

}  // namespace

RenderSettings panel_settings(const RenderSettings& settings, std::uint32_t seed_offset, int divisor) {
    RenderSettings of_panel = settings;
    of_panel.width = preview_side(settings.width, divisor);
    of_panel.height = preview_side(settings.height, divisor);
    of_panel.seed = neighbor_seed(settings.seed, seed_offset);
    // A camera moves at any time, and a chain then looks back to where it was.
    of_panel.moves = chains_frames(settings);
    // Where frames go on from one another their spread says too little of the mean's error.
    of_panel.standard_error = settings.standard_error && !chains_frames(settings);
    return of_panel;
}

PanelEngine::PanelEngine(std::string backend, std::uint32_t seed_offset, RendererFactory factory, Publish publish)
    : factory_(std::move(factory)), seed_offset_(seed_offset), publish_(std::move(publish)) {
    shot_.backend = std::move(backend);
}

void PanelEngine::Pace::spent(double begin, double end) {
    const double pause = std::max(interval - (end - begin), (end - begin) / share);
    next = end + pause;
}

template <class Work>
void PanelEngine::guarded(const Work& work) {
    try {
        work();
    } catch (const std::exception& error) {
        shot_.error = one_line(with_option_names(error.what()));
        shot_.device_lost = dynamic_cast<const DeviceLost*>(&error) != nullptr;
        shot_.busy.clear();
        applied_.reset();
        publish_(std::make_shared<const PanelShot>(shot_));
    }
}

void PanelEngine::recover(RendererFactory factory) {
    session_.reset();
    applied_.reset();
    shot_.device_film.reset();
    shot_.device_lost = false;
    factory_ = std::move(factory);
    if (job_) {
        apply(ViewJob(*job_));
    }
}

void PanelEngine::apply(const ViewJob& job) {
    if (shot_.device_lost) {
        job_ = job;
        return;
    }
    guarded([&] {
        const double begin = now_seconds();
        Change level = applied_ && session_ ? invalidation(*applied_, job.state) : Change::scene;
        const RenderSettings& wanted = job.state.request.settings;
        if (level == Change::scene) {
            speed_ = {};
        }
        relearns_ = relearns_ || level == Change::settings;
        const FrameBudget budget =
            frame_budget(speed_, wanted.width, wanted.height, job.frame_seconds, job.moving, divisor_);
        if (budget.divisor != divisor_) {
            level = std::max(level, Change::settings);
        }
        if (spoiled_) {
            level = std::max(level, Change::picture);
        }
        job_ = job;
        resumes_ = begin;
        divisor_ = budget.divisor;
        shot_.error.clear();
        applied_.reset();  // until it is done
        switch (level) {
        case Change::nothing:
            break;
        case Change::picture:
            session_->restart(settings().seed);
            begin_picture();
            break;
        case Change::view:
        case Change::moment:
            session_->show(moment_of(job_->state),
                           session_->chained() ? std::nullopt : std::optional(settings().seed));
            begin_picture();
            break;
        case Change::settings:
            session_->set(settings(), moment_of(job_->state));
            begin_picture();
            break;
        case Change::scene:
            open_scene();
            break;
        }
        applied_ = job.state;
        spoiled_ = false;
        if (level == Change::view || level == Change::moment) {
            speed_.overhead_seconds = blended(speed_.overhead_seconds, now_seconds() - begin);
        }
        aim_dispatches(session_->renderer(), job.frame_seconds / 2);
        const bool knows_picture = level == Change::nothing && shot_.figures.version == shot_.version;
        shot_.version = job.version;
        shot_.state = job.state;
        shot_.busy.clear();
        if (knows_picture) {
            shot_.figures.version = job.version;
        }
        if (level == Change::nothing && samples_ > 0) {
            publish(false);
        }
    });
}

void PanelEngine::open_scene() {
    session_.reset();
    shot_.device_film.reset();
    scene_ = job_->scene;
    SessionHooks hooks = reporting_hooks();
    hooks.busy = [this](const std::string& what) { say_busy(what); };
    session_.emplace(
        *scene_, settings(),
        [this](const Scene&, const PackedScene& packed, const RenderSettings&) { return factory_(packed); },
        moment_of(job_->state), std::move(hooks));
    shot_.backend = session_->renderer().backend();
    shot_.device = session_->renderer().device();
    begin_picture();
}

void PanelEngine::begin_picture() {
    samples_ = 0;
    looked_rays_ = 0;
    looked_at_ = now_seconds();
    passes_before_ = session_->renderer().pass_times();
    passes_from_ = 0;
}

void PanelEngine::advance(const std::atomic<bool>& cancel) {
    guarded([&] {
        const RenderSettings& wanted = job_->state.request.settings;
        const FrameBudget budget =
            frame_budget(speed_, wanted.width, wanted.height, job_->frame_seconds, job_->moving, divisor_);
        const bool first = samples_ == 0;
        // At rest the first sample is shown at once. What moves is shown once a frame, by as many as fit; of a chain
        // only the first looks back to the frame before.
        const bool one = first && (!job_->moving || session_->looks_back());
        const std::uint32_t count = one ? 1 : std::min(budget.samples, samples_left());
        const double begin = now_seconds();
        session_->render(samples_, count, cancel);
        if (cancel) {
            spoiled_ = true;
            return;
        }
        samples_ += count;
        learn(count, now_seconds() - begin);
        publish(first);
        resumes_ = now_seconds() + (job_->moving ? job_->frame_seconds : 0);
    });
}

void PanelEngine::learn(std::uint32_t samples, double seconds) {
    const RenderSettings now = settings();
    const double done = static_cast<double>(now.width) * now.height * samples;
    const double known = std::exchange(relearns_, false) ? 0 : speed_.samples_per_second;
    speed_.samples_per_second = blended(known, done / std::max(seconds, 1e-9));
    shot_.frame_milliseconds = 1000 * seconds;
}

void PanelEngine::publish(bool first) {
    const double now = now_seconds();
    const RenderSettings of_film = settings();
    shot_.device_film = device_film_of(session_->renderer());
    shot_.width = of_film.width;
    shot_.height = of_film.height;
    shot_.divisor = divisor_;
    shot_.spp = samples_;
    shot_.correlated = reuses(of_film.integrator);
    shot_.samples_per_second = speed_.samples_per_second;
    shot_.costs = session_->renderer().costs();
    // A film on the device is shown from there, and no motion waits for a copy of it.
    if (shot_.device_film ? !job_->moving && device_looks_.due(now) : first || host_films_.due(now)) {
        look();
    }
    publish_(std::make_shared<const PanelShot>(shot_));
}

void PanelEngine::look() {
    const double begin = now_seconds();
    shot_.film = std::make_shared<const Film>(session_->renderer().film());
    host_films_.spent(begin, now_seconds());
    if (shot_.device_film || looks_.due(begin)) {
        shot_.figures = film_figures(*shot_.film, job_->version, samples_);
        const double seconds = begin - looked_at_;
        shot_.rays_per_second = static_cast<double>(shot_.figures.rays - looked_rays_) / std::max(seconds, 1e-9);
        looked_rays_ = shot_.figures.rays;
        looked_at_ = begin;
        shot_.passes = session_->renderer().pass_times();
        for (std::size_t i = 0; i < shot_.passes.size(); ++i) {
            const double before = i < passes_before_.size() ? passes_before_[i].seconds : 0;
            const double taken = std::exchange(shot_.passes[i].seconds, 0) - before;
            shot_.passes[i].seconds = taken / std::max(samples_ - passes_from_, 1U);
        }
        passes_before_ = session_->renderer().pass_times();
        passes_from_ = samples_;
        looks_.spent(begin, now_seconds());
    }
    device_looks_.spent(begin, now_seconds());
}

void PanelEngine::say_busy(const std::string& what) {
    shot_.busy = what;
    publish_(std::make_shared<const PanelShot>(shot_));
}

RecordedPath PanelEngine::record_path(shared::PathQuery query, std::uint32_t seed) {
    if (!session_ || !applied_) {
        throw Error("there is no panel to replay on");
    }
    const RenderSettings of_film = settings();
    if (resamples(of_film.integrator)) {
        throw Error("replay traces single samples, but this integrator resamples a frame as a whole");
    }
    const auto divisor = static_cast<std::uint32_t>(divisor_);
    query.pixel = {std::min(query.pixel.x / divisor, static_cast<std::uint32_t>(of_film.width - 1)),
                   std::min(query.pixel.y / divisor, static_cast<std::uint32_t>(of_film.height - 1))};
    RecordedPath path = session_->renderer().record_paths({&query, 1}, seed).front();
    // Panels may have been packed about different origins, where the camera stood then.
    for (shared::PathVertexRecord& vertex : path.vertices) {
        if (vertex.instance != shared::NONE) {
            vertex.position += glm::vec3(session_->packed().origin);
        }
    }
    return path;
}

KeptFilm PanelEngine::film() {
    if (!has_picture()) {
        throw Error("there is no picture yet");
    }
    KeptFilm kept;
    kept.film = session_->renderer().film();
    kept.request = view_request(job_->state, *job_->scene);
    kept.request.backend = shot_.backend;
    kept.camera = job_->state.camera;
    kept.request.settings = settings();
    kept.request.settings.moves = false;  // what a renderer is told, not what is asked for
    const FilmTotals totals = film_totals(kept.film);
    kept.outcome.maker = this_program();
    kept.outcome.device = shot_.device;
    kept.outcome.spp = samples_;
    kept.outcome.uneven = spoiled_;
    kept.outcome.seconds = static_cast<double>(totals.samples) / std::max(speed_.samples_per_second, 1e-9);
    kept.outcome.rays = totals.rays;
    kept.outcome.nonfinite = totals.nonfinite;
    return kept;
}

}  // namespace diptych::core::app
