#include "commands/render/picture.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "commands/render/live_view.h"
#include "commands/render/picture_json.h"
#include "commands/render/picture_work.h"
#include "console/exit_codes.h"
#include "console/interrupt.h"
#include "console/output.h"
#include "console/progress_line.h"
#include "console/report.h"
#include "error.h"
#include "render/lasting_picture.h"

namespace diptych::core::app {

namespace {

/// Seconds for the last picture to reach a viewer: a twentieth of the rendering time, and no wait that a user feels
/// where the render was interrupted.
double last_show_seconds(const ProgressiveResult& result) {
    return result.interrupted ? 0 : std::min(result.seconds / 20, 10.0);
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

/// Renders the samples that are missing between those that ranks of an earlier run have left. Returns whether it was
/// interrupted within `result`.
bool fill_gaps(PictureWork& work, Session& session, const std::atomic<bool>& cancel, const ProgressiveHooks& hooks,
               ProgressiveResult& result) {
    while (work.has_gap() && !cancel) {
        result = render_progressively(session, *work.target(), cancel, hooks);
        if (result.interrupted) {
            return true;
        }
        work.keep(session.film(), result);
        session.restart(session.settings().seed);
        result = {};
    }
    return false;
}

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
        print_note("{}: going on from its {} samples per pixel\n", fmt::join(work.kept().paths, ", "), work.kept().spp);
    }
    const std::uint32_t kept_spp = work.kept().spp;
    Picture picture;
    std::optional<ProgressLine> line(std::in_place, request.spp, audience.label);
    ProgressiveResult result;
    ProgressiveHooks hooks;
    hooks.base = work.kept().spp > 0 ? &work.kept().film : nullptr;
    hooks.progress = [&](const Progress& progress) {
        line->show(progress);
        result.seconds = progress.seconds;
    };
    const std::function<void(const Film&)> checkpoint = work.checkpoints();
    if (checkpoint || audience.live != nullptr) {
        hooks.film = [&](const Film& grown) {
            if (checkpoint) {
                checkpoint(grown);
            }
            if (audience.live != nullptr) {
                audience.live->show(request.output, develop(grown, FilmLayers::color).color, cancel);
            }
        };
    }
    const bool in_gap = fill_gaps(work, session, cancel, hooks, result);
    const std::optional<ProgressiveTarget> target = work.target();
    LastingPicture lasting(session, guard, cancel, begin, target ? target->first : 0);
    const bool can_be_lost = request.backend == "vulkan";
    Renderer& renderer = can_be_lost ? lasting : session.renderer();
    const DeviceSeconds device_seconds(renderer, session.renderer());
    const int losses_before = guard.losses();
    std::shared_ptr<const Film> kept_film;
    try {
        if (target && !in_gap) {
            result = can_be_lost ? render_progressively(lasting, *target, cancel, hooks)
                                 : render_progressively(session, *target, cancel, hooks);
        }
        kept_film = work.whole(can_be_lost ? std::make_shared<const Film>(lasting.take_film()) : renderer.film_in_place());
    } catch (const DeviceLost& error) {
        kept_film = work.whole(std::make_shared<Film>(lasting.kept()));
        result.spp = lasting.kept_samples();
        result.interrupted = picture.lost = true;
        line.reset();
        report_error(fmt::format("{}: {}; {} samples per pixel are saved, {} are lost", request.output, error.what(),
                                 work.kept().spp + lasting.kept_samples(), lasting.lost_samples()));
    }
    line.reset();  // its last line stands before what follows
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
        audience.live->finish(request.output, develop(film, FilmLayers::color).color, last_show_seconds(result));
    }
    picture.saved = true;
    picture.fell_back = saved.fell_back;
    if (totals.nonfinite > 0) {
        report_warning(fmt::format("{}: {} of {} samples were dropped: they were not finite, or negative", saved.path,
                                   totals.nonfinite, totals.samples + totals.nonfinite));
    }
    if (audience.quiet) {  // else nobody reads the JSON, whose estimate of the error takes long
        picture.json = json_of(request, outcome, saved, renderer, film, totals, session.packed().features);
        picture.json["kept_spp"] = kept_spp;
        device_seconds.put(renderer, session.renderer(), guard.losses() == losses_before, picture.json);
        if (can_be_lost) {
            picture.json["device_losses"] = guard.losses() - losses_before;
        }
    }
    picture.line = fmt::format("{}: {}x{}, {} spp in {:.2f} s on {}{}{}\n", saved.path, film.width, film.height,
                               outcome.spp, outcome.seconds, outcome.device, outcome.interrupted ? ", interrupted" : "",
                               outcome.interrupted && work.resumable() ? "; the same command goes on from it" : "");
    if (!audience.quiet) {
        write_note(picture.line);
    }
    return picture;
}

}  // namespace diptych::core::app
