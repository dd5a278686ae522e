// Options that several commands share, from text to a RenderRequest.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/request.h"
#include "settings/ranges.h"
#include "scene/scene.h"

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace diptych::core::app {

/// Options as typed, and the request that they fill.
struct RenderArguments {
    RenderRequest request;
    std::string integrator = "path";
    std::string brdf = "ggx";
    std::string normal_maps = "shading";
    std::string sampler = "sobol";
    std::string mis = "power";
    std::string light_sampler = "spatial";
    std::string resampling_mis = "pairwise";
    std::string resampling_visibility = "shading";
    std::vector<CLI::Option*> resampling_options;  // that mean nothing without ris or restir
    std::string size;
    std::vector<CLI::Option*> panel_options;  // those that mean nothing to the oracle
    CLI::Option* oracle_option = nullptr;     // --oracle-mode
};

/// Checks of numeric options. CLI11's own ranges let NaN through, and print 309 digits where they have no upper end.
CLI::Validator finite_number();
CLI::Validator positive_number();
CLI::Validator non_negative_number();
CLI::Validator number_between(double least, double most);
CLI::Validator accepted_by(const SettingRange& range);

/// The option that sets it: "--max-depth".
std::string option_of(const SettingRange& range);

/// --memory-limit, in bytes. Throws nothing; CLI11 refuses what is no amount.
void add_memory_option(CLI::App& command, std::uint64_t& limit);

void add_integrator_option(CLI::App& command, RenderArguments& arguments);

/// What changes the scene (environment, camera, lens, size) and what decides its features.
void add_scene_options(CLI::App& command, RenderArguments& arguments);

/// Which backend, and how it is to work.
void add_backend_options(CLI::App& command, RenderArguments& arguments);

/// How the oracle is to find light.
void add_oracle_option(CLI::App& command, RenderArguments& arguments);

/// Throws Error where the mode is unknown, stands without the oracle, or an option stands with it that means nothing to
/// it.
void resolve_oracle_mode(const RenderArguments& arguments);

/// Another place for the camera, and a sun; add_scene_options calls it.
void add_viewpoint_options(CLI::App& command, RenderArguments& arguments);

/// How ris and restir resample; add_scene_options and resolve_names call these.
void add_resampling_options(CLI::App& command, RenderArguments& arguments);
void resolve_resampling_names(RenderArguments& arguments);

/// Throws Error for an integrator whose samples depend on one another, in a command that takes each by itself.
void refuse_resampling(const char* option, Integrator integrator, const char* command);

/// Throws Error where an option of resampling was given and nothing will resample.
void refuse_idle_resampling_options(const RenderArguments& arguments, bool resampled);

/// How a picture with 8 bits a channel is made: --exposure and --tonemap. `of` ends their help.
void add_display_options(CLI::App& command, double& exposure, std::string& tonemap, const char* of);

/// Names to values, and options that contradict the backend refused. Throws Error naming the option.
void resolve_names(RenderArguments& arguments);

/// The scene as the options have it, and with its camera the picture's size; its warnings reported, once each. Throws
/// Error.
Scene prepare_scene(RenderArguments& arguments);

/// "WxH", or a height to which the camera's aspect gives the width; empty is 512 high. Throws Error.
void resolve_size(RenderArguments& arguments, const Camera& camera);

}  // namespace diptych::core::app
