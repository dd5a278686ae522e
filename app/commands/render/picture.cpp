#include "commands/render/picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "commands/render/live_view.h"
#include "pack/features.h"
#include "console/progress_line.h"
#include "render/film_statistics.h"
#include "render/progressive.h"
#include "console/repeat_command.h"
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

nlohmann::ordered_json to_json(const RenderRequest& request, const RenderOutcome& outcome, const Renderer& renderer,
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

Picture render_picture(Session& session, const RenderRequest& request, const std::atomic<bool>& cancel,
                       const PictureAudience& audience) {
    const Renderer& renderer = session.renderer();
    const double device_seconds = renderer.device_seconds();
    const std::vector<PassTime> passes_before = renderer.pass_times();
    ProgressiveResult result;
    {
        ProgressLine line(request.spp, audience.label);
        ProgressiveTarget target;
        target.spp = request.spp;
        target.seconds = request.seconds;
        target.relmse = request.target_error;
        ProgressiveHooks hooks;
        hooks.progress = [&](const Progress& progress) { line.show(progress); };
        if (audience.live != nullptr) {
            hooks.film = [&](const Film& film) { audience.live->show(request.output, develop(film).color); };
        }
        result = render_progressively(session, target, cancel, hooks);
    }
    const Film film = renderer.film();
    const FilmTotals totals = film_totals(film);
    RenderOutcome outcome;
    outcome.maker = this_program();
    outcome.device = renderer.device();
    outcome.spp = result.spp;
    outcome.interrupted = result.interrupted;
    outcome.uneven = is_uneven(film);
    outcome.seconds = result.seconds;
    outcome.rays = totals.rays;
    outcome.nonfinite = totals.nonfinite;
    Picture picture;
    picture.interrupted = result.interrupted;
    if (totals.samples + totals.nonfinite == 0) {
        report_error(fmt::format("{}: interrupted before the first sample; nothing to save", request.output));
        return picture;
    }
    const LayeredImage layers = save_film(film, request, outcome);
    if (audience.live != nullptr) {
        audience.live->show(request.output, layers.color);
    }
    picture.saved = true;
    if (totals.nonfinite > 0) {
        report_warning(
            fmt::format("{}: {} of {} samples were dropped: they were not finite, negative, or too large to sum",
                        request.output, totals.nonfinite, totals.samples + totals.nonfinite));
    }
    std::vector<PassTime> passes = renderer.pass_times();
    for (std::size_t i = 0; i < passes.size(); ++i) {
        passes[i].seconds -= passes_before[i].seconds;
    }
    picture.json = to_json(request, outcome, renderer, totals, estimated_relmse(film),
                           session.packed().features, renderer.device_seconds() - device_seconds, passes);
    if (!audience.quiet) {
        fmt::print("{}: {}x{}, {} spp in {:.2f} s on {}{}\n", request.output, film.width, film.height, outcome.spp,
                   outcome.seconds, outcome.device, outcome.interrupted ? ", interrupted" : "");
    }
    return picture;
}

}  // namespace diptych::core::app
