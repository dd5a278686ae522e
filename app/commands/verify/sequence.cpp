#include "commands/verify/sequence.h"

#include <fmt/format.h>

#include <algorithm>

#include "error.h"

namespace diptych::core::app {

void add_sequence_options(CLI::App& command, VerifyOptions& options, CLI::Option& paired) {
    RenderRequest& request = options.arguments.request;
    CLI::Option* frame =
        command
            .add_option("--frame", options.frames,
                        "Frames of a sequence to test, comma-separated; default with --start or --orbit: 0,1,2,4,8,16")
            ->delimiter(',')
            ->check(CLI::Range(0U, 999999U));
    CLI::Option* start =
        command.add_option("--start", request.start, "Time of frame 0 in the scene's animations, seconds")
            ->check(non_negative_number());
    CLI::Option* orbit =
        command.add_option("--orbit", request.orbit,
                           "Rotation of the camera about the point it looks at, degrees per frame")
            ->check(finite_number());
    CLI::Option* fps =
        command.add_option("--fps", request.fps, "Frames per second")->check(positive_number())->capture_default_str();
    CLI::Option* frame_spp =
        command.add_option("--frame-spp", options.frame_spp, "restir: samples per pixel of each frame")
            ->check(CLI::Range(1U, 4096U))
            ->capture_default_str();
    for (CLI::Option* option : {frame, start, orbit, fps, frame_spp}) {
        option->excludes(&paired);
    }
    options.sequence_options = {frame, start, orbit};
    options.sequence_details = {fps, frame_spp};
}

void resolve_frames(VerifyOptions& options) {
    const auto given = [](const CLI::Option* option) { return option->count() > 0; };
    std::vector<std::uint32_t>& frames = options.frames;
    if (frames.empty() && std::any_of(options.sequence_options.begin(), options.sequence_options.end(), given)) {
        frames = {0, 1, 2, 4, 8, 16};
    }
    std::sort(frames.begin(), frames.end());
    const auto twice = std::adjacent_find(frames.begin(), frames.end());
    if (twice != frames.end()) {
        throw Error(fmt::format("--frame: names {} twice", *twice));
    }
    for (const CLI::Option* option : options.sequence_details) {
        if (frames.empty() && given(option)) {
            throw Error(fmt::format("{}: works only with --frame, --start or --orbit", option->get_name()));
        }
    }
    for (const auto& [name, spp] : {std::pair("--spp", options.spp), {"--against-spp", options.against_spp}}) {
        if (options.seconds == 0 && spp % options.frame_spp != 0) {
            throw Error(fmt::format("{} {}: is not a multiple of --frame-spp {}", name, spp, options.frame_spp));
        }
    }
}

}  // namespace diptych::core::app
