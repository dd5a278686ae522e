#include "commands/render/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "commands/render/live_view.h"
#include "commands/render/picture_work.h"
#include "console/exit_codes.h"
#include "console/interrupt.h"
#include "console/output.h"
#include "console/progress_line.h"
#include "console/repeat_command.h"
#include "console/report.h"
#include "error.h"
#include "pack/features.h"
#include "render/film_statistics.h"
#include "render/lasting_picture.h"
#include "settings/names.h"

namespace diptych::core::app {

namespace {

/// Seconds for the last picture to reach a viewer: a twentieth of the rendering time, and no wait that a user feels
/// where the render was interrupted.
double last_show_seconds(const ProgressiveResult& result) {
    return result.interrupted ? 0 : std::min(result.seconds / 20, 10.0);
}

nlohmann::ordered_json json_of(const RenderRequest& request, const RenderOutcome& outcome, const SavedPicture& saved,
                               const Renderer& renderer, const Film& film, std::uint32_t features) {
    const RendererCosts costs = renderer.costs();
    const FilmTotals totals = film_totals(film);
    const std::optional<double> relmse = estimated_relmse(film);
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
    json["output"] = saved.path;
    json["fell_back"] = saved.fell_back;
    json["interrupted"] = outcome.interrupted;
    json["build_seconds"] = costs.build_seconds;
    json["compile_seconds"] = costs.compile_seconds;
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

/// Seconds of the device, in all and by pass, since a renderer was as it was here.
class DeviceSeconds {
public:
    explicit DeviceSeconds(const Renderer& whole, const Renderer& passes)
        : seconds_(whole.device_seconds()), passes_(passes.pass_times()) {}

    void put(const Renderer& whole, const Renderer& passes, bool same_device, nlohmann::ordered_json& json) const {
        json["device_seconds"] = whole.device_seconds() - seconds_;
        const std::vector<PassTime> now = passes.pass_times();
        for (std::size_t i = 0; i < now.size(); ++i) {
            json["pass_seconds"][now[i].pass] = now[i].seconds - (same_device ? passes_[i].seconds : 0);
        }
    }

private:
    double seconds_;
    std::vector<PassTime> passes_;
};

}  // namespace

int picture_exit_code(const Picture& picture) {
    return picture.lost          ? exit_no_device
           : picture.interrupted ? interrupt_exit_code()
           : picture.fell_back   ? exit_bad_input
                                 : exit_done;
}

Picture render_picture(Session& session, const RenderRequest& request, const std::atomic<bool>& cancel,
                       const PictureAudience& audience, const WorkFiles& files, LossGuard& guard,
                       const std::function<void()>& begin) {
    PictureWork work(session, request, files);
    work.find_kept();
    if (work.kept().spp > 0 && !audience.quiet) {
        print_note("{}: going on from its {} samples per pixel\n", work.kept().path, work.kept().spp);
    }
    const std::optional<ProgressiveTarget> target = work.target();
    LastingPicture lasting(session, guard, cancel, begin, target ? target->first : 0);
    const bool can_be_lost = request.backend == "vulkan";
    Renderer& renderer = can_be_lost ? lasting : session.renderer();
    const DeviceSeconds device_seconds(renderer, session.renderer());
    const int losses_before = guard.losses();
    Picture picture;
    ProgressiveResult result;
    std::shared_ptr<const Film> kept_film;
    try {
        ProgressLine line(request.spp, audience.label);
        ProgressiveHooks hooks;
        hooks.base = work.kept().spp > 0 ? &work.kept().film : nullptr;
        hooks.progress = [&](const Progress& progress) {
            line.show(progress);
            result.seconds = progress.seconds;
        };
        const std::function<void(const Film&)> checkpoint = work.checkpoints();
        if (checkpoint || audience.live != nullptr) {
            hooks.film = [&](const Film& grown) {
                if (checkpoint) {
                    checkpoint(grown);
                }
                if (audience.live != nullptr) {
                    audience.live->show(request.output, develop(grown).color, cancel);
                }
            };
        }
        if (target) {
            result = can_be_lost ? render_progressively(lasting, *target, cancel, hooks)
                                 : render_progressively(session, *target, cancel, hooks);
        }
        kept_film = work.whole(can_be_lost ? std::make_shared<const Film>(lasting.take_film()) : renderer.film_in_place());
    } catch (const DeviceLost& error) {
        kept_film = work.whole(std::make_shared<Film>(lasting.kept()));
        result.spp = lasting.kept_samples();
        result.interrupted = picture.lost = true;
        report_error(fmt::format("{}: {}; {} samples per pixel are saved, {} are lost", request.output, error.what(),
                                 work.kept().spp + lasting.kept_samples(), lasting.lost_samples()));
    }
    const Film& film = *kept_film;
    const RenderOutcome outcome = work.outcome_of(result, film, renderer.device());
    picture.interrupted = result.interrupted;
    const FilmTotals totals = film_totals(film);
    if (totals.samples + totals.nonfinite == 0) {
        report_error(fmt::format("{}: {} before the first sample; nothing to save", request.output,
                                 picture.lost ? "the device was lost" : "interrupted"));
        return picture;
    }
    const SavedPicture saved = work.save(film, outcome);
    if (audience.live != nullptr) {
        audience.live->finish(request.output, saved.layers.color, last_show_seconds(result));
    }
    picture.saved = true;
    picture.fell_back = saved.fell_back;
    if (totals.nonfinite > 0) {
        report_warning(fmt::format("{}: {} of {} samples were dropped: they were not finite, or negative", saved.path,
                                   totals.nonfinite, totals.samples + totals.nonfinite));
    }
    picture.json = json_of(request, outcome, saved, renderer, film, session.packed().features);
    picture.json["kept_spp"] = work.kept().spp;
    device_seconds.put(renderer, session.renderer(), guard.losses() == losses_before, picture.json);
    if (can_be_lost) {
        picture.json["device_losses"] = guard.losses() - losses_before;
    }
    if (!audience.quiet) {
        print_note("{}: {}x{}, {} spp in {:.2f} s on {}{}{}\n", saved.path, film.width, film.height, outcome.spp,
                   outcome.seconds, outcome.device, outcome.interrupted ? ", interrupted" : "",
                   outcome.interrupted && work.resumable() ? "; the same command goes on from it" : "");
    }
    return picture;
}

}  // namespace diptych::core::app
