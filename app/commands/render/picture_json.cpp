#include "commands/render/picture_json.h"

#include <algorithm>

#include "console/repeat_command.h"
#include "pack/features.h"
#include "render/film_statistics.h"
#include "settings/names.h"

namespace diptych::core::app {

nlohmann::ordered_json json_of(const RenderRequest& request, const RenderOutcome& outcome, const SavedPicture& saved,
                               const Renderer& renderer, const Film& film, const FilmTotals& totals,
                               std::uint32_t features) {
    const RendererCosts costs = renderer.costs();
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

}  // namespace diptych::core::app
