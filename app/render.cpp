#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "arguments.h"
#include "backend.h"
#include "command.h"
#include "error.h"
#include "image/image_file.h"
#include "image/tonemap_image.h"
#include "interrupt.h"
#include "pack/features.h"
#include "progress_line.h"
#include "render/film_statistics.h"
#include "render/progressive.h"
#include "render/render_metadata.h"
#include "render/settings_names.h"
#include "report.h"
#include "scene_setup.h"

namespace diptych::app {

namespace {

constexpr const char* examples = R"(Examples:
  diptych render scene.gltf -o picture.exr
  diptych render scene.glb -o picture.png --backend vulkan --time 10 --size 1920x1080 --tonemap aces
  diptych render scene.gltf -o truth.exr --backend oracle --oracle-mode area --spp 4096
  diptych render scene.gltf -o picture.exr --env studio.hdr --env-rotate 90 --camera Front --spp 1024
EXR holds linear colour, standard error, albedo, normal and depth, with metadata that repeats the render: the command is
in the attribute diptych:command. PNG is tone mapped; HDR is linear. Ctrl-C saves the work so far and exits with 130.)";

struct Options {
    RenderArguments arguments;
    CLI::Option* layers_option = nullptr;
    bool layers = true;
    std::uint32_t sample_count = 0;
    bool json = false;
};

void check_options(Options& options) {
    RenderRequest& request = options.arguments.request;
    RenderSettings& settings = request.settings;
    resolve_names(options.arguments);
    resolve_oracle_mode(options.arguments);
    tonemap_from_name(request.tonemap);
    if (request.seconds > 0) {
        request.spp = 0;
    }
    settings.sample_count = options.sample_count > 0 ? options.sample_count : request.spp;
    if (settings.sampler == SamplerKind::hammersley && settings.sample_count == 0) {
        throw Error("--sampler hammersley: is laid out for a known number of samples: give --spp or --sample-count");
    }
    check_writable(request.output);
    const bool exr = image_format(request.output) == ImageFormat::Exr;
    if (!exr && options.layers && options.layers_option->count() > 0) {
        throw Error(fmt::format("--layers: {} cannot hold them, only .exr can", request.output));
    }
    settings.standard_error = exr && options.layers;
    settings.first_hit_layers = exr && options.layers;
}

void save(const RenderRequest& request, LayeredImage layers, const RenderOutcome& outcome) {
    switch (image_format(request.output)) {
    case ImageFormat::Exr:
        layers.metadata = render_metadata(request, outcome);
        write_exr(request.output, layers);
        break;
    case ImageFormat::Png:
        write_png(request.output,
                  tonemapped(layers.color, tonemap_from_name(request.tonemap), static_cast<float>(request.exposure)));
        break;
    case ImageFormat::Hdr:
        write_hdr(request.output, layers.color);
        break;
    }
}

/// Some pixels have more samples than others.
bool is_uneven(const Film& film) {
    const auto count = [](const shared::FilmPixel& pixel) { return pixel.samples + pixel.nonfinite; };
    return std::any_of(film.pixels.begin(), film.pixels.end(),
                       [&](const shared::FilmPixel& pixel) { return count(pixel) != count(film.pixels.front()); });
}

nlohmann::ordered_json to_json(const RenderRequest& request, const RenderOutcome& outcome, const Renderer& renderer,
                               const FilmTotals& totals, const std::optional<double>& relmse, std::uint32_t features) {
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
    json["device_seconds"] = renderer.device_seconds();
    json["bytes"] = costs.bytes;
    json["features"] = feature_names(features);
    json["samples_per_second"] = static_cast<double>(totals.samples + totals.nonfinite) / seconds;
    json["rays_per_second"] = static_cast<double>(outcome.rays) / seconds;
    json["estimated_relmse"] = relmse ? nlohmann::ordered_json(*relmse) : nlohmann::ordered_json();
    json["command"] = repeat_command(request, outcome.spp);
    return json;
}

int run_render(Options options) {
    check_options(options);
    RenderRequest& request = options.arguments.request;
    const Scene scene = prepare_scene(options.arguments);
    PackedScene packed = pack_scene(scene, request.settings);
    const std::uint32_t features = packed.features;
    const std::unique_ptr<Renderer> renderer = make_renderer(scene, packed, request);

    ProgressiveResult result;
    {
        InterruptGuard interrupt;
        ProgressLine line(request.spp);
        ProgressiveTarget target;
        target.spp = request.spp;
        target.seconds = request.seconds;
        ProgressiveHooks hooks;
        hooks.progress = [&](const Progress& progress) { line.show(progress); };
        result = render_progressively(*renderer, target, interrupt.requested(), hooks);
    }
    const Film film = renderer->film();
    const FilmTotals totals = film_totals(film);
    RenderOutcome outcome;
    outcome.program = program_version();
    outcome.device = renderer->device();
    outcome.spp = result.spp;
    outcome.interrupted = result.interrupted;
    outcome.uneven = is_uneven(film);
    outcome.seconds = result.seconds;
    outcome.rays = totals.rays;
    outcome.nonfinite = totals.nonfinite;
    if (totals.samples + totals.nonfinite == 0) {
        report_error(fmt::format("{}: interrupted before the first sample; nothing to save", request.output));
        return exit_interrupted;
    }
    save(request, develop(film), outcome);
    if (totals.nonfinite > 0) {
        report_warning(fmt::format("{}: {} of {} samples were not finite, negative or beyond what is summed, and were dropped",
                                   request.output, totals.nonfinite, totals.samples + totals.nonfinite));
    }
    if (options.json) {
        print_json(to_json(request, outcome, *renderer, totals, estimated_relmse(film), features));
    } else {
        fmt::print("{}: {}x{}, {} spp in {:.2f} s on {}{}\n", request.output, film.width, film.height, outcome.spp,
                   outcome.seconds, outcome.device, outcome.interrupted ? ", interrupted" : "");
    }
    return outcome.interrupted ? exit_interrupted : exit_done;
}

}  // namespace

void add_render(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("render", "Render a glTF scene to an image");
    auto options = std::make_shared<Options>();
    RenderRequest& request = options->arguments.request;
    command->add_option("scene", request.scene, ".gltf or .glb file")->required();
    command->add_option("-o,--output", request.output, "Image to write: .exr, .png or .hdr")->required();
    CLI::Option* spp = command->add_option("--spp", request.spp, "Samples a pixel")
                           ->check(CLI::Range(1U, 4294967295U))
                           ->capture_default_str();
    command->add_option("--time", request.seconds, "Render for so many seconds instead, to the nearest whole sample")
        ->check(CLI::Range(0.001, 1e9))
        ->check(finite_number())
        ->excludes(spp);
    options->arguments.panel_options.push_back(
        command
            ->add_option("--sample-count", options->sample_count,
                         "Samples that hammersley is laid out for; --spp by default")
            ->check(CLI::Range(1U, 4294967295U)));
    command->add_option("--seed", request.settings.seed, "Another seed, other noise")->capture_default_str();
    add_integrator_option(*command, options->arguments);
    add_scene_options(*command, options->arguments);
    add_backend_options(*command, options->arguments);
    add_oracle_option(*command, options->arguments);
    command->add_option("--exposure", request.exposure, "EV, powers of two; for .png")
        ->check(CLI::Range(-100.0, 100.0))
        ->check(finite_number());
    command->add_option("--tonemap", request.tonemap, "none, exponential, uncharted2, aces or pbr-neutral; for .png")
        ->capture_default_str();
    options->layers_option = command->add_flag("--layers,!--no-layers", options->layers,
                                               "Write the layers beside colour; .exr only, on by default");
    command->add_flag("--json", options->json, "Results as JSON on stdout");
    command->footer(examples);
    command->callback([options, &run] { run = [options] { return run_render(*options); }; });
}

}  // namespace diptych::app
