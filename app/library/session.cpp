#include "diptych/session.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "backends/backends.h"
#include "library/impl.h"
#include "library/version.h"
#include "pack/fingerprint.h"
#include "pose/pose.h"
#include "render/film_tiles.h"
#include "render/merge_films.h"
#include "render/progressive.h"

DIPTYCH_BEGIN

core::RenderSettings SessionData::core_settings() const {
    core::RenderSettings out = to_core(settings);
    // Reuse looks back to the picture before, which costs memory: only where there is another moment or view.
    out.moves =
        choice.backend != Backend::oracle && core::chains_frames(out) && (core::moves(*content) || moment.camera);
    return out;
}

core::RenderRequest SessionData::request() const {
    core::RenderRequest out;
    out.scene = content->name;
    out.backend = core_name(choice.backend);
    out.device = choice.device;
    out.threads = choice.threads;
    out.validation = choice.validation;
    out.frames = moment.seconds ? 1 : 0;  // so that the metadata name the moment
    out.start = moment.seconds.value_or(0);
    out.settings = to_core(settings);
    return out;
}

core::Session& SessionData::running() {
    if (!session) {
        open();
    }
    return *session;
}

void SessionData::begin_picture() {
    samples = {};
    seconds = 0;
    base.reset();
    fingerprint.clear();
}

void SessionData::open() {
    session.reset();
    core::SessionHooks hooks;
    hooks.warn = [this](const std::vector<std::string>& lines) {
        for (const std::string& line : lines) {
            if (options.warnings && warned.insert(line).second) {
                options.warnings(line);
            }
        }
    };
    session = std::make_unique<core::Session>(*content, core_settings(), core::app::renderer_maker(request()), moment,
                                              std::move(hooks));
    begin_picture();
}

void SessionData::follow_edits() {
    std::shared_ptr<const core::Scene> edited = scene->snapshot();
    if (edited == content) {
        running();
        return;
    }
    check(settings, edited->cameras.size());
    const bool in_place =
        session && session->renderer().capabilities().reconfigures && core::editable_in_place(*content, *edited);
    revision = scene->revision;
    std::swap(content, edited);  // the old one lives until the session has let go of it
    if (in_place) {
        session->edit(*content);
        begin_picture();
    } else {
        open();
    }
}

void SessionData::go_to(const core::Moment& next, const Settings& wanted) {
    const core::Moment moment_before = std::exchange(moment, next);
    const Settings settings_before = std::exchange(settings, wanted);
    try {
        const core::RenderSettings asked = core_settings();
        const core::Change change = running().change_to(moment, asked);
        if (change < core::Change::settings) {
            session->show(moment);
        } else if (session->renderer().capabilities().reconfigures) {
            session->set(asked, moment);
        } else {
            open();
        }
    } catch (...) {
        moment = moment_before;
        settings = settings_before;
        session.reset();  // it is of no use once a call has thrown
        throw;
    }
    begin_picture();
}

Session::Session(const Scene& scene, const BackendChoice& backend, const Settings& settings,
                 const SessionOptions& options)
    : data_(std::make_unique<SessionData>()) {
    guarded([&] {
        check(backend);
        data_->scene = Impl::shared(scene);
        data_->content = data_->scene->snapshot();
        data_->revision = data_->scene->revision;
        check(settings, data_->content->cameras.size());
        data_->choice = backend;
        data_->settings = settings;
        data_->options = options;
        data_->open();
    });
}

Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

RenderResult Session::render_range(std::uint32_t first, std::uint32_t count, const RenderOptions& options) {
    return guarded([&] {
        SessionData& d = *data_;
        d.follow_edits();
        if (first < d.done()) {
            throw Error(fmt::format("session: sample {} was rendered before; the next is {}", first, d.done()));
        }
        if (count == 0 && options.seconds <= 0 && options.relmse <= 0) {
            throw SettingError("session: 0 samples need a limit of seconds or relmse");
        }
        if (options.relmse > 0 && !d.settings.standard_error) {
            throw SettingError("session: relmse needs the setting standard_error");
        }
        // The film stays even, whole samples of every pixel, so that what follows goes on from there.
        const std::atomic<bool> never{false};
        std::atomic<bool> stopped{false};
        std::uint32_t rendered = 0;
        core::ProgressiveHooks hooks;
        hooks.base = d.base ? &d.base->film : nullptr;
        hooks.render = [&](std::uint32_t from, std::uint32_t samples, const std::atomic<bool>&) {
            if (options.stop.stop_requested()) {
                stopped = true;
                return;
            }
            d.session->render(from, samples, never);
            rendered += samples;
        };
        if (options.progress) {
            hooks.progress = [&](const core::Progress& p) {
                options.progress({p.spp, p.seconds, p.eta_seconds, p.samples_per_second, p.rays_per_second, p.relmse});
            };
        }
        RenderResult result;
        const auto keep = [&] {
            if (rendered > 0) {
                d.samples.add({first, std::uint64_t{first} + rendered});
            }
            d.seconds += result.seconds;
        };
        try {
            const core::ProgressiveResult done = core::render_progressively(
                d.session->renderer(), {first, count, options.seconds, options.relmse}, stopped, hooks);
            result = {rendered, done.seconds, done.interrupted};
        } catch (...) {
            keep();
            throw;
        }
        keep();
        return result;
    });
}

RenderResult Session::render(std::uint32_t count, const RenderOptions& options) {
    guarded([&] { data_->follow_edits(); });
    return render_range(data_->done(), count, options);
}

/// What the metadata tell of a picture, but for its samples.
core::RenderOutcome SessionData::outcome() {
    if (fingerprint.empty()) {
        fingerprint = core::scene_fingerprint(running().packed());
    }
    core::RenderOutcome out;
    out.maker.program = program_version();
    out.device = running().renderer().device();
    out.fingerprint = fingerprint;
    return out;
}

Film Session::film() const {
    return guarded([&] {
        SessionData& d = *data_;
        auto film = std::make_shared<FilmData>();
        film->film = d.running().film();
        if (d.base) {
            core::merge_films(d.base->film, film->film);
        }
        const core::FilmTotals totals = core::film_totals(film->film);
        FilmInfo& info = film->info;
        info.scene = d.content->name;
        info.backend = d.choice.backend;
        info.device = device();
        info.settings = d.settings;
        info.spp = static_cast<std::uint32_t>(d.samples.count());
        info.samples = totals.samples;
        info.nonfinite = totals.nonfinite;
        info.rays = totals.rays;
        info.seconds = d.seconds;
        core::RenderOutcome outcome = d.outcome();
        outcome.spp = info.spp;
        outcome.samples = d.chained() ? core::SampleRanges() : d.samples;
        outcome.seconds = info.seconds;
        outcome.rays = info.rays;
        outcome.nonfinite = info.nonfinite;
        film->metadata = core::render_metadata(d.request(), outcome);
        film->samples = {{d.settings.seed, {"film", d.samples}}};
        film->origin = FilmOrigin{d.revision, d.moment};
        film->developed = core::develop(film->film);
        return Impl::make_film(std::move(film));
    });
}

void Session::resume(const Film& film) {
    guarded([&] {
        SessionData& d = *data_;
        const std::shared_ptr<const FilmData> base = Impl::shared(film);
        d.follow_edits();
        require_sums(*base);
        if (!d.samples.empty()) {
            throw Error("session: the picture has samples already; restart it before it goes on from a film");
        }
        if (d.chained()) {
            throw SettingError("session: the samples of restir go on from one another, and cannot go on from a film");
        }
        core::require_same_picture(base->name(), base->metadata, "the session's picture",
                                   core::render_metadata(d.request(), d.outcome()));
        core::SampleRanges samples;
        for (const FilmSamples& each : base->samples) {
            if (each.seed != d.settings.seed) {
                throw Error(fmt::format("{}: has samples of seed {} too, and the session's are of seed {}",
                                        base->name(), each.seed, d.settings.seed));
            }
            samples.add(each.part.samples);
        }
        d.samples = samples;
        d.seconds = base->info.seconds;
        d.base = base;
    });
}

void Session::restart(std::optional<std::uint32_t> seed) {
    guarded([&] {
        SessionData& d = *data_;
        d.settings.seed = seed.value_or(d.settings.seed);
        d.running().restart(d.settings.seed);
        d.begin_picture();
    });
}

void Session::pose(std::optional<double> seconds) {
    guarded([&] {
        if (seconds && !std::isfinite(*seconds)) {
            throw Error("session: a moment has to be a finite number of seconds");
        }
        data_->follow_edits();
        core::Moment next = data_->moment;
        next.seconds = seconds;
        data_->go_to(next, data_->settings);
    });
}

void Session::set_camera(const std::optional<Camera>& camera) {
    guarded([&] {
        if (camera) {
            check(*camera);
        }
        data_->follow_edits();
        core::Moment next = data_->moment;
        next.camera.reset();
        if (camera) {
            next.camera = to_core(*camera);
        }
        data_->go_to(next, data_->settings);
    });
}

void Session::set_settings(const Settings& settings) {
    guarded([&] {
        data_->follow_edits();
        check(settings, data_->content->cameras.size());
        data_->go_to(data_->moment, settings);
    });
}

const Settings& Session::settings() const {
    return data_->settings;
}

Backend Session::backend() const {
    return data_->choice.backend;
}

std::string Session::device() const {
    return guarded([&] { return data_->running().renderer().device(); });
}

Capabilities Session::capabilities() const {
    const core::Capabilities c = guarded([&] { return data_->running().renderer().capabilities(); });
    return {c.chains, c.reconfigures, c.paths};
}

DIPTYCH_END
