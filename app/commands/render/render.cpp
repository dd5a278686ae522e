#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "commands/arguments/arguments.h"
#include "commands/arguments/device_loss.h"
#include "commands/command.h"
#include "error.h"
#include "image/image_file.h"
#include "image/tonemap_image.h"
#include "console/interrupt.h"
#include "console/opening_line.h"
#include "commands/render/kept_work.h"
#include "commands/render/live_view.h"
#include "session/open_session.h"
#include "settings/names.h"
#include "commands/render/picture.h"
#include "commands/render/rank_picture.h"
#include "commands/render/rank_run.h"
#include "commands/render/save_picture.h"
#include "commands/render/sequence.h"
#include "console/report.h"
#include "pose/pose.h"
#include "ranks/launcher.h"
#include "session/input_files.h"
#include "session/scene_setup.h"

namespace diptych::core::app {

namespace {

constexpr const char* render_examples = R"(Examples:
  diptych render scene.gltf -o picture.exr
  diptych render scene.glb -o picture.png --backend vulkan --time 10 --size 1920x1080 --tonemap aces
  diptych render scene.gltf -o clean.exr --target-error 1e-3 --time 600
  diptych render scene.gltf -o truth.exr --backend oracle --spp 4096
  diptych render scene.gltf -o picture.exr --time 60 --live localhost:14158
  diptych render scene.gltf -o picture.exr --env studio.hdr --env-rotate 90 --camera Front --spp 1024
  diptych render scene.glb -o walk.####.exr --frames 96 --fps 24 --camera moving
  diptych render scene.glb -o around.png --frames 36 --orbit 10 --tonemap aces
  diptych render scene.glb -o film.####.exr --frames 96 --integrator restir --spp 1 --warm-up 24
  diptych render scene.glb -o night.exr --spp 65536 --checkpoint night.check.exr --every 300
  diptych render scene.glb -o part2.exr --samples 512:1024
--frames plays the scene's animations from --start on and writes one file per frame. #### in the file name stands
for the frame number; without it the number comes before the extension. Frame i has the seed --seed + i. With
restir, all frames have the seed --seed, and each frame reuses the previous one. The metadata of each file hold a
command that renders this frame alone.
EXR holds linear colour, standard error, albedo, normal and depth. Its attribute diptych:command holds the command
that repeats the render. PNG is tone mapped; HDR is linear. Ctrl-C saves the samples so far and exits with code 130;
SIGTERM, SIGHUP and SIGXCPU do so with 143, 129 and 152.
An interrupted render leaves picture.part.exr beside its output, and the same command goes on from it, to the same
bits. --samples renders a part of the samples, anywhere; 'diptych merge' puts parts together. A sequence skips frames
that are finished. 'mpirun -n N diptych render ...' divides the samples, or the frames of a sequence, among N processes.)";

struct RenderOptions {
    RenderArguments arguments;
    CLI::Option* spp_option = nullptr;
    CLI::Option* layers_option = nullptr;
    CLI::Option* sequence_option = nullptr;
    CLI::Option* fps_option = nullptr;
    CLI::Option* start_option = nullptr;
    CLI::Option* orbit_option = nullptr;
    CLI::Option* warm_up_option = nullptr;
    CLI::Option* samples_option = nullptr;
    CLI::Option* first_frame_option = nullptr;
    CLI::Option* checkpoint_option = nullptr;
    CLI::Option* resume_option = nullptr;
    CLI::Option* every_option = nullptr;
    std::string samples;
    WorkFiles files;
    bool layers = true;
    std::uint32_t sample_count = 0;
    std::uint32_t first_frame = 0;
    std::string live;  // HOST:PORT
    std::string on_device_lost = "stop";
    bool json = false;
};

/// Parts of a picture and files to go on from have no sense where samples go on from one another.
void check_parts(RenderOptions& options) {
    RenderRequest& request = options.arguments.request;
    if (options.samples_option->count() > 0) {
        try {
            request.samples = parse_range(options.samples);
        } catch (const Error& error) {
            throw Error(fmt::format("--samples: {}", error.what()));
        }
        request.spp = static_cast<std::uint32_t>(request.samples->end - request.samples->first);
        request.sums = true;
    }
    if (request.sums && image_format(request.output) != ImageFormat::Exr) {
        throw Error(fmt::format("-o {}: cannot hold the sums of its samples; only .exr can", request.output));
    }
    if (options.every_option->count() > 0 && options.files.checkpoint.empty()) {
        throw Error("--every: works only with --checkpoint");
    }
    for (CLI::Option* option : {options.samples_option, options.checkpoint_option, options.resume_option}) {
        if (option->count() == 0) {
            continue;
        }
        if (request.frames > 0) {
            throw Error(fmt::format("{}: is for one picture; a sequence goes on where it was interrupted by itself, and "
                                    "is split by --first-frame",
                                    option->get_name()));
        }
        if (request.backend != "oracle" && chains_frames(request.settings)) {
            throw Error(fmt::format("{}: restir with --temporal builds each sample on the one before, so its samples "
                                    "cannot be split; give --no-temporal, or split a sequence by --first-frame with "
                                    "--warm-up",
                                    option->get_name()));
        }
        if (request.warm_up > 0) {
            throw Error(fmt::format("{}: does not go with --warm-up", option->get_name()));
        }
    }
    if (!options.files.checkpoint.empty() && image_format(options.files.checkpoint) != ImageFormat::Exr) {
        throw Error(fmt::format("--checkpoint {}: must be an .exr file", options.files.checkpoint));
    }
}

std::vector<std::filesystem::path> written_files(const RenderRequest& request, const WorkFiles& files) {
    std::vector<std::filesystem::path> paths;
    for (std::uint32_t frame = 0; frame < std::max(request.frames, 1U); ++frame) {
        paths.emplace_back(frame_path(request.output, frame, request.frames));
    }
    if (!files.checkpoint.empty()) {
        paths.emplace_back(files.checkpoint);
    }
    return paths;
}

void check_render_options(RenderOptions& options) {
    RenderRequest& request = options.arguments.request;
    device_loss_policy(options.on_device_lost, true, request);
    RenderSettings& settings = request.settings;
    resolve_names(options.arguments);
    resolve_oracle_mode(options.arguments);
    refuse_idle_resampling_options(options.arguments, resamples(settings.integrator));
    tonemap_from_name(request.tonemap);
    if (options.warm_up_option->count() > 0 && !(request.backend != "oracle" && chains_frames(settings))) {
        throw Error("--warm-up: works only with --integrator restir and --temporal, which reuse the previous frame");
    }
    if (options.samples_option->count() > 0 && (request.seconds > 0 || request.target_error > 0)) {
        throw Error("--samples: says how many samples there are; --time and --target-error do too");
    }
    if (request.seconds > 0 || (request.target_error > 0 && options.spp_option->count() == 0)) {
        request.spp = 0;
    }
    if (request.target_error > 0 && request.backend != "oracle" && resamples(settings.integrator)) {
        throw Error(fmt::format(
            "--target-error: {} resamples a frame as a whole, so the spread of its samples does not give the error",
            name_of(settings.integrator)));
    }
    check_parts(options);
    if (request.samples && settings.sampler == SamplerKind::hammersley && options.sample_count == 0) {
        throw Error("--samples: a part of a hammersley set needs the size of the whole set; give --sample-count");
    }
    settings.sample_count = options.sample_count > 0 ? options.sample_count : request.spp;
    if (settings.sampler == SamplerKind::hammersley && settings.sample_count == 0) {
        throw Error("--sampler hammersley: needs a known number of samples; give --spp or --sample-count");
    }
    if (options.sequence_option->count() + options.start_option->count() + options.orbit_option->count() > 0) {
        request.frames = std::max(request.frames, 1U);
    } else if (options.fps_option->count() > 0) {
        throw Error("--fps: works only with --frames");
    }
    if (request.seconds > 0 && chains_frames(settings) && request.frames + request.warm_up > 1) {
        throw Error(
            "--time: frames of restir that reuse each other need a fixed number of samples each; give --spp");
    }
    if (chains_frames(settings) &&
        static_cast<double>(request.warm_up) + request.frames > 4294967295.0 / std::max(request.spp, 1U)) {
        throw Error("--frames: frames of restir that reuse each other have at most 4294967295 samples together");
    }
    if (options.first_frame_option->count() > 0 && options.first_frame + std::uint64_t{1} > request.frames) {
        throw Error(fmt::format("--first-frame {}: the sequence has {} frames, from 0 on", options.first_frame,
                                request.frames));
    }
    const std::string first_output = frame_path(request.output, options.first_frame, request.frames);
    check_writable(first_output);
    if (!options.files.fallback_folder.empty()) {
        check_fallback(options.files.fallback_folder, first_output);
    }
    refuse_inputs(written_files(request, options.files), request);
    if (!options.files.checkpoint.empty()) {
        check_writable(options.files.checkpoint);
        if (std::filesystem::weakly_canonical(options.files.checkpoint) == std::filesystem::weakly_canonical(request.output)) {
            throw Error(fmt::format("--checkpoint {}: is -o too, which is written when the picture is done; give another",
                                    options.files.checkpoint));
        }
    }
    if (request.frames == 0) {
        refuse_to_lose(request, options.files);
    }
    const bool exr = image_format(request.output) == ImageFormat::Exr;
    if (!exr && options.layers && options.layers_option->count() > 0) {
        throw Error(fmt::format("--layers: {} cannot hold layers; only .exr can", request.output));
    }
    if (request.target_error > 0 && exr && !options.layers) {
        throw Error("--no-layers: --target-error needs the layer of standard errors");
    }
    // Where frames go on from one another their spread says too little of the mean's error: better no layer than a
    // wrong one.
    settings.standard_error = ((exr && options.layers) || request.target_error > 0) && !chains_frames(settings);
    settings.first_hit_layers = exr && options.layers;
}

int run_still(const RenderOptions& options, const Scene& scene, LiveView* live) {
    const RenderRequest& request = options.arguments.request;
    if (moves(scene)) {
        report_warning(
            fmt::format("{}: its animations are not played and it is shown at rest; give --frames or --start",
                        scene.name));
    }
    LossGuard guard(device_loss_policy(options.on_device_lost, true, request));
    OpeningLine opening(options.json);
    Session session = guard.open([&](const MakeRenderer& instead) {
        return open_session(scene, request, instead, [&](const std::string& what) { opening.begin(what); });
    });
    opening.close();
    InterruptGuard interrupt;
    const auto begin = [&] {
        if (request.warm_up > 0) {
            session.render(0, request.warm_up, interrupt.requested());
            session.next_picture();
        }
    };
    guard.run(session, interrupt.requested(), begin);
    const Picture picture =
        render_picture(session, request, interrupt.requested(), {.label = "", .quiet = options.json, .live = live},
                       options.files, guard, begin);
    if (options.json && picture.saved) {
        print_json(picture.json);
    }
    return picture_exit_code(picture);
}

/// What several processes cannot share.
void refuse_on_ranks(const RenderOptions& options) {
    const RenderRequest& request = options.arguments.request;
    if (request.backend != "oracle" && chains_frames(request.settings)) {
        throw Error("--integrator restir: with --temporal each sample builds on the one before, so several ranks cannot "
                    "share them; give --no-temporal, or divide a sequence by --first-frame with --warm-up among jobs of "
                    "one process");
    }
    if (request.target_error > 0) {
        throw Error("--target-error: the error is judged by the film of all samples, which no rank has before the end; "
                    "give --spp or --time");
    }
    if (!options.live.empty()) {
        throw Error("--live: no rank has the film of all samples before the end; render in one process");
    }
}

int run_still_on_ranks(RankRun& run, const RenderOptions& options, const Scene& scene) {
    const RenderRequest& request = options.arguments.request;
    if (moves(scene)) {
        report_warning(
            fmt::format("{}: its animations are not played and it is shown at rest; give --frames or --start",
                        scene.name));
    }
    Session session = open_session(scene, request);
    LossGuard guard(device_loss_policy(options.on_device_lost, true, request));
    return render_picture_on_ranks(run, session, request, options.json, options.files, guard);
}

/// `run` is null where this process renders alone.
int render_as_asked(RenderOptions options, RankRun* run) {
    check_render_options(options);
    RenderRequest& request = options.arguments.request;
    if (run != nullptr) {
        refuse_on_ranks(options);
        run->take_share(request);
    }
    const std::unique_ptr<LiveView> live = options.live.empty() ? nullptr : std::make_unique<LiveView>(options.live);
    const Scene scene = prepare_scene(options.arguments);
    if (request.frames > 0) {
        report_clips(scene, request);
        return render_sequence(scene, request,
                               {.first_frame = options.first_frame,
                                .files = options.files,
                                .on_device_lost = device_loss_policy(options.on_device_lost, true, request),
                                .json = options.json,
                                .live = live.get(),
                                .run = run});
    }
    return run != nullptr ? run_still_on_ranks(*run, options, scene) : run_still(options, scene, live.get());
}

int run_render(const RenderOptions& options) {
    if (launcher().empty()) {
        return render_as_asked(options, nullptr);
    }
    return RankRun::run([&](RankRun& run) { return render_as_asked(options, &run); });
}

}  // namespace

void add_render(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("render", "Render a glTF scene to an image");
    auto options = std::make_shared<RenderOptions>();
    RenderRequest& request = options->arguments.request;
    command->add_option("scene", request.scene, ".gltf or .glb file")->required();
    command->add_option("-o,--output", request.output, "Image to write: .exr, .png or .hdr")->required();
    CLI::Option* spp = command->add_option("--spp", request.spp, "Samples per pixel in all, those of a resumed file among them")
                           ->check(CLI::Range(1U, 4294967295U))
                           ->capture_default_str();
    options->spp_option = spp;
    command
        ->add_option("--target-error", request.target_error,
                     "Stop when the relMSE, estimated from 16 samples on, is below this; --spp and --time are limits")
        ->check(positive_number());
    command
        ->add_option("--time", request.seconds,
                     "Rendering time in seconds, to the nearest whole sample; replaces --spp")
        ->check(CLI::Range(0.001, 1e9))
        ->check(finite_number())
        ->excludes(spp);
    options->arguments.panel_options.push_back(
        command
            ->add_option("--sample-count", options->sample_count,
                         "Size of the hammersley set, samples per pixel; default: --spp")
            ->check(CLI::Range(1U, 4294967295U)));
    options->samples_option =
        command->add_option("--samples", options->samples,
                            "FIRST:END: these samples alone, as a part for 'diptych merge'; 0:64 are the first 64");
    options->samples_option->excludes(spp);
    command->add_flag("--sums", request.sums,
                      "Keep the sums of the samples in the .exr, so that it can be merged and resumed");
    options->checkpoint_option = command->add_option(
        "--checkpoint", options->files.checkpoint,
        "Write the samples so far into this .exr as the picture grows, and go on from it if it is there");
    options->every_option = command
                                ->add_option("--every", options->files.every, "Seconds from one checkpoint to the next")
                                ->check(positive_number())
                                ->capture_default_str();
    options->resume_option =
        command->add_option("--resume", options->files.resume, "Go on from the samples of this .exr");
    command->add_flag("--overwrite", options->files.overwrite,
                      "Begin anew, and replace files that hold more samples, or finished frames");
    command->add_option("--seed", request.settings.seed, "Seed of the random numbers; another seed gives other noise")
        ->capture_default_str();
    options->sequence_option = command
                                   ->add_option("--frames", request.frames,
                                                "Number of frames of a sequence; --spp or --time is per frame")
                                   ->check(CLI::Range(1U, 1000000U));
    options->first_frame_option =
        command->add_option("--first-frame", options->first_frame, "First frame of the sequence to render, from 0");
    options->fps_option =
        command->add_option("--fps", request.fps, "Frames per second")->check(positive_number())->capture_default_str();
    options->start_option =
        command->add_option("--start", request.start, "Time of the first frame in the scene's animations, seconds")
            ->check(non_negative_number());
    options->orbit_option =
        command->add_option("--orbit", request.orbit,
                            "Rotation of the camera about the point it looks at, degrees per frame")
            ->check(finite_number());
    options->warm_up_option = command->add_option(
        "--warm-up", request.warm_up,
        "restir: frames to render and discard before the first one; without --frames, samples");
    add_integrator_option(*command, options->arguments);
    add_scene_options(*command, options->arguments);
    add_backend_options(*command, options->arguments);
    add_oracle_option(*command, options->arguments);
    add_display_options(*command, request.exposure, request.tonemap, "for .png files");
    options->layers_option =
        command->add_flag("--layers,!--no-layers", options->layers,
                          "Also write standard error, albedo, normal and depth (.exr only); on by default");
    command->add_option(
        "--live", options->live,
        "HOST:PORT of a running tev viewer to show the progress in; tev's default is 127.0.0.1:14158");
    command
        ->add_option("--fallback-dir", options->files.fallback_folder,
                     "Folder for a picture that cannot be written to -o, as when the disk is full; exit code 2")
        ->type_name("DIR");
    add_device_loss_option(*command, options->on_device_lost, true);
    command->add_flag("--json", options->json, "Print the results as JSON");
    command->footer(render_examples);
    command->callback([options, &run] { run = [options] { return run_render(*options); }; });
}

}  // namespace diptych::core::app
