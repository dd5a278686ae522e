#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/arguments/arguments.h"
#include "error.h"
#include "settings/names.h"

namespace diptych::core::app {

void add_resampling_options(CLI::App& command, RenderArguments& arguments) {
    ResamplingSettings& settings = arguments.request.settings.resampling;
    const auto add = [&](const char* name, auto& value, const char* help) {
        CLI::Option* option = command.add_option(name, value, help);
        arguments.resampling_options.push_back(option);
        return option->group("Resampling (ris, restir)")->capture_default_str();
    };
    const auto add_number = [&](const SettingRange& range, auto& value, const char* help) {
        add(option_of(range).c_str(), value, help)->check(accepted_by(range));
    };
    const auto flag = [&](const char* name, bool& value, const char* help) {
        arguments.resampling_options.push_back(command.add_flag(name, value, help)->group("Resampling (ris, restir)"));
    };
    add_number(ranges::candidates, settings.light_candidates,
               "Light candidates per pixel and frame, picked from all lights");
    add_number(ranges::near_share, settings.near_share,
               "Fraction of the light candidates picked by power and distance, from light clusters; the rest by power");
    flag("--bsdf-candidate,!--no-bsdf-candidate", settings.bsdf_candidate,
         "Add a candidate from BSDF sampling where the BSDF is glossy or emitters are close; on by default");
    flag("--temporal,!--no-temporal", settings.temporal,
         "restir: reuse the reservoirs of the previous frame; on by default");
    add_number(ranges::spatial_passes, settings.spatial_passes, "restir: number of spatial reuse passes");
    add_number(ranges::neighbors, settings.neighbors, "restir: neighbours per spatial pass");
    add_number(ranges::reuse_radius, settings.radius, "restir: radius of the disk of these neighbours, pixels");
    add_number(ranges::confidence_cap, settings.confidence_cap,
               "restir: cap on the confidence of the previous frame, in frames");
    add("--reuse-mis", arguments.resampling_mis,
        "restir: MIS weights of reuse, pairwise, balance, 1-over-z or biased-1-over-m");
    add("--reuse-visibility", arguments.resampling_visibility,
        "Where visibility is tested: shading, target, biased-initial or biased-final");
    add("--atlas", arguments.request.settings.atlas_tile,
        "Fill the film with isolated copies of the view, of this side in pixels; 0: one view")
        ->check(CLI::Range(0, 4096));
}

void resolve_resampling_names(RenderArguments& arguments) {
    ResamplingSettings& settings = arguments.request.settings.resampling;
    settings.mis = resampling_mis_from_name(arguments.resampling_mis);
    settings.visibility = resampling_visibility_from_name(arguments.resampling_visibility);
}

void refuse_resampling(const char* option, Integrator integrator, const char* command) {
    if (resamples(integrator)) {
        throw Error(fmt::format("{} {}: {} traces single samples, but this integrator resamples a frame as a whole",
                                option, name_of(integrator), command));
    }
}

void refuse_idle_resampling_options(const RenderArguments& arguments, bool resampled) {
    for (const CLI::Option* option : arguments.resampling_options) {
        if (option->count() > 0 && !resampled) {
            throw Error(fmt::format("{}: works only with --integrator ris or restir", option->get_name()));
        }
    }
}

}  // namespace diptych::core::app
