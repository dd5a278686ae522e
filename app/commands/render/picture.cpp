#include "commands/render/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "clock.h"
#include "commands/render/live_view.h"
#include "pack/features.h"
#include "pack/fingerprint.h"
#include "console/output.h"
#include "console/progress_line.h"
#include "render/film_statistics.h"
#include "render/progressive.h"
#include "console/repeat_command.h"
#include "render/merge_films.h"
#include "render/metadata.h"
#include "settings/names.h"
#include "console/report.h"

namespace diptych::core::app {

namespace {

/// Some pixels have more samples than others.
bool is_uneven(const Film& film) {
    const auto count = [](const shared::FilmPixel& pixel) { return pixel.samples + pixel.nonfinite; };
    return std::any_of(film.pixels.begin(), film.pixels.end(),
                       [&](const shared::FilmPixel& pixel) { return count(pixel) != count(film.pixels.front()); });
}

nlohmann::ordered_json picture_json(const RenderRequest& request, const RenderOutcome& outcome, const Renderer& renderer,
                               const FilmTotals& totals, const std::optional<double>& relmse, std::uint32_t features,
                               double device_seconds, const std::vector<PassTime>& passes) {
    const RendererCosts costs = renderer.costs();
    const double seconds = std::max(outcome.seconds, 1e-12);
    nlohmann::ordered_json json;
    json["backend"] = renderer.backend();
    json["device"] = outcome.device;
    if (request.backend == "oracle") {
        json["oracle_mode"] = request.oracle_mode;
    } else {
        json["integrator"] = name_of(request.settings.integrator);
    }
    json["width"] = request.settings.width;
    json["height"] = request.settings.height;
    json["spp"] = outcome.spp;
    json["seconds"] = outcome.seconds;
    json["rays"] = outcome.rays;
    json["nonfinite"] = outcome.nonfinite;
    json["output"] = request.output;
    json["interrupted"] = outcome.interrupted;
    json["build_seconds"] = costs.build_seconds;
    json["compile_seconds"] = costs.compile_seconds;
    json["device_seconds"] = device_seconds;
    for (const PassTime& pass : passes) {
        json["pass_seconds"][pass.pass] = pass.seconds;
    }
    json["bytes"] = costs.bytes;
    json["features"] = feature_names(features);
    json["samples_per_second"] = static_cast<double>(totals.samples + totals.nonfinite) / seconds;
    json["rays_per_second"] = static_cast<double>(outcome.rays) / seconds;
    json["correlated"] = request.backend != "oracle" && request.settings.integrator == Integrator::restir;
    json["estimated_relmse"] = relmse ? nlohmann::ordered_json(*relmse) : nlohmann::ordered_json();
    if (request.target_error > 0) {
        json["target_error"] = request.target_error;
        json["target_met"] = relmse && *relmse <= request.target_error;
    }
    if (request.frames > 0) {
        json["frame"] = request.frame;
        json["time"] = shown_at(request);
    }
    json["command"] = repeat_command(request, outcome.spp);
    return json;
}

}  // namespace

namespace {

/// One picture on its way: what is known of it before, and what becomes of it.
class Work {
public:
    Work(Session& session, const RenderRequest& request, const PictureAudience& audience)
        : session_(session), request_(request), audience_(audience),
          // Frames that go on from one another cannot be gone on with by another process, which has not seen them.
          resumable_(request.backend == "oracle" || !chains_frames(request.settings)) {
        outcome_.maker = this_program();
        outcome_.device = session.renderer().device();
    }

    ProgressiveResult render(const std::atomic<bool>& cancel) {
        const bool may_resume = resumable_ && audience_.files != nullptr;
        if (may_resume && (!audience_.files->resume.empty() || !audience_.files->checkpoint.empty() ||
                           std::filesystem::exists(part_path(request_.output)))) {
            name_scene();
            kept_ = find_kept_work(session_, request_, *audience_.files, render_metadata(request_, outcome_));
        }
        if (kept_.spp > 0 && !audience_.quiet) {
            print_note("{}: going on from its {} samples per pixel\n", kept_.path, kept_.spp);
        }
        ProgressiveTarget target;
        target.first = (request_.samples ? static_cast<std::uint32_t>(request_.samples->first) : 0) + kept_.spp;
        target.spp = request_.spp > 0 ? request_.spp - kept_.spp : 0;
        target.seconds = request_.seconds > 0 ? request_.seconds - kept_.seconds : 0;
        target.relmse = request_.target_error;
        if (kept_.look_at > 0) {
            target.look_at = kept_.look_at;
        }
        const bool done = kept_.spp > 0 && ((request_.spp > 0 && target.spp == 0) ||
                                            (request_.seconds > 0 && target.seconds <= 0));
        return done ? ProgressiveResult{} : render_to(target, cancel);
    }

    /// The film with the samples that were kept.
    Film whole_film() const {
        Film film = session_.film();
        if (kept_.spp > 0) {
            merge_films(kept_.film, film);
        }
        return film;
    }

    /// How the render went, of which the film has come.
    RenderOutcome outcome_of(const ProgressiveResult& result, const Film& film) const {
        const FilmTotals totals = film_totals(film);
        RenderOutcome outcome = outcome_;
        outcome.spp = kept_.spp + result.spp;
        outcome.samples = samples_to(outcome.spp);
        outcome.interrupted = result.interrupted;
        outcome.uneven = is_uneven(film);
        outcome.look_at = result.look_at > 0 ? result.look_at : kept_.look_at;
        outcome.seconds = kept_.seconds + result.seconds;
        outcome.rays = totals.rays;
        outcome.nonfinite = totals.nonfinite;
        return outcome;
    }

    void settle(const ProgressiveResult& result, const Film& film) { outcome_ = outcome_of(result, film); }

    /// Writes what is finished to the output, and what is not beside it. Returns where.
    std::pair<std::string, LayeredImage> save(const Film& film) {
        RenderRequest request = request_;
        if (outcome_.interrupted && audience_.files != nullptr) {
            request.output = unfinished_path();
            request.sums = resumable_;
        }
        if (request.sums || !checkpoint().empty()) {
            name_scene();
        }
        LayeredImage layers = save_film(film, request, outcome_);
        if (!checkpoint().empty() && checkpoint() != request.output) {
            write_checkpoint(film, outcome_);
        }
        if (!outcome_.interrupted && kept_.path == part_path(request_.output)) {
            std::filesystem::remove(kept_.path);  // all that it held is in the picture
        }
        return {request.output, std::move(layers)};
    }

    const RenderOutcome& outcome() const { return outcome_; }
    const KeptWork& kept() const { return kept_; }
    bool resumable() const { return resumable_; }

private:
    std::string checkpoint() const {
        return audience_.files != nullptr && resumable_ ? audience_.files->checkpoint : std::string();
    }

    SampleRanges samples_to(std::uint32_t spp) const {
        const std::uint64_t first = request_.samples ? request_.samples->first : 0;
        return resumable_ ? SampleRanges({first, first + spp}) : SampleRanges();
    }

    void name_scene() {
        if (outcome_.fingerprint.empty()) {
            outcome_.fingerprint = scene_fingerprint(session_.packed());
        }
    }

    /// A checkpoint where one is kept, else beside the output; never over a file of more samples.
    std::string unfinished_path() const {
        if (!checkpoint().empty()) {
            return checkpoint();
        }
        std::string path = part_path(request_.output);
        for (int number = 2; samples_in(path) > outcome_.samples.count() && path != kept_.path; ++number) {
            path = part_path(fmt::format("{}-{}.exr", request_.output.substr(0, request_.output.rfind('.')), number));
        }
        return path;
    }

    void write_checkpoint(const Film& film, const RenderOutcome& outcome) const {
        RenderRequest request = request_;
        request.output = checkpoint();
        request.sums = true;
        save_film(film, request, outcome);
    }

    ProgressiveResult render_to(const ProgressiveTarget& target, const std::atomic<bool>& cancel) {
        ProgressLine line(request_.spp, audience_.label);
        ProgressiveHooks hooks;
        hooks.base = kept_.spp > 0 ? &kept_.film : nullptr;
        hooks.progress = [&](const Progress& progress) { line.show(progress); };
        std::optional<Checkpoints> checkpoints;
        const Stopwatch watch;
        if (!checkpoint().empty()) {
            name_scene();
            checkpoints.emplace(audience_.files->every, [&](const Film& film) {
                ProgressiveResult so_far;
                so_far.spp = samples_of_every_pixel(film) - kept_.spp;
                so_far.seconds = watch.seconds();
                so_far.interrupted = true;
                write_checkpoint(film, outcome_of(so_far, film));
            });
        }
        if (checkpoints || audience_.live != nullptr) {
            hooks.film = [&](const Film& film) {
                if (checkpoints) {
                    checkpoints->offer(film);
                }
                if (audience_.live != nullptr) {
                    audience_.live->show(request_.output, develop(film).color);
                }
            };
        }
        return render_progressively(session_, target, cancel, hooks);
    }

    Session& session_;
    const RenderRequest& request_;
    const PictureAudience& audience_;
    bool resumable_;
    KeptWork kept_;
    RenderOutcome outcome_;
};

}  // namespace

Picture render_picture(Session& session, const RenderRequest& request, const std::atomic<bool>& cancel,
                       const PictureAudience& audience) {
    const Renderer& renderer = session.renderer();
    const double device_seconds = renderer.device_seconds();
    const std::vector<PassTime> passes_before = renderer.pass_times();
    Work work(session, request, audience);
    const ProgressiveResult result = work.render(cancel);
    const Film film = work.whole_film();
    work.settle(result, film);
    const FilmTotals totals = film_totals(film);
    Picture picture;
    picture.interrupted = result.interrupted;
    if (totals.samples + totals.nonfinite == 0) {
        report_error(fmt::format("{}: interrupted before the first sample; nothing to save", request.output));
        return picture;
    }
    const auto [path, layers] = work.save(film);
    if (audience.live != nullptr) {
        audience.live->show(request.output, layers.color);
    }
    picture.saved = true;
    if (totals.nonfinite > 0) {
        report_warning(fmt::format("{}: {} of {} samples were dropped: they were not finite, or negative", path,
                                   totals.nonfinite, totals.samples + totals.nonfinite));
    }
    std::vector<PassTime> passes = renderer.pass_times();
    for (std::size_t i = 0; i < passes.size(); ++i) {
        passes[i].seconds -= passes_before[i].seconds;
    }
    picture.json = picture_json(request, work.outcome(), renderer, totals, estimated_relmse(film),
                           session.packed().features, renderer.device_seconds() - device_seconds, passes);
    picture.json["output"] = path;
    picture.json["kept_spp"] = work.kept().spp;
    if (!audience.quiet) {
        print_note("{}: {}x{}, {} spp in {:.2f} s on {}{}\n", path, film.width, film.height, work.outcome().spp,
                   work.outcome().seconds, work.outcome().device,
                   !result.interrupted    ? ""
                   : work.resumable() ? ", interrupted; the same command goes on from it"
                                          : ", interrupted");
    }
    return picture;
}

}  // namespace diptych::core::app
