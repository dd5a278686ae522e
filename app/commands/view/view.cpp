#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "commands/arguments/arguments.h"
#include "commands/command.h"
#include "error.h"
#include "image/image_file.h"
#include "image/tonemap_image.h"
#include "console/report.h"
#include "session/input_files.h"
#include "session/scene_setup.h"
#include "view/headless.h"
#include "view/loader.h"
#include "view/shown_names.h"
#if DIPTYCH_VIEW
#include "window/view_window.h"
#include "window/window.h"
#endif

namespace diptych::core::app {

namespace {

constexpr const char* view_examples = R"(Examples:
  diptych view scene.gltf
  diptych view scene.glb --panel split --integrator restir --env studio.hdr
  diptych view scene.glb --headless --frames 240 --size 1920x1080 --panel vulkan -o last.png
The left mouse button orbits, the middle button pans, the wheel moves closer. WASD and QE fly. F1 shows all keys.
--headless needs no display. It orbits during the first half of the frames, rests during the second half, and prints
the frame times.)";

struct ViewOptions {
    RenderArguments arguments;
    std::string panel = "split";
    std::string device;  // kept from the request until its names are resolved: it goes with either panel
    int threads = 0;
    bool validation = false;
    double frames_per_second = 60;
    double scale = 1;
    bool headless = false;
    std::uint32_t frames = 120;
    std::string output;
    std::string log;
    std::string folder = ".";
    double interface_scale = 0;
    bool json = false;
    std::vector<CLI::Option*> headless_options;
    std::vector<CLI::Option*> window_options;
};

/// ViewOptions that mean nothing to the kind of view.
void refuse_given(const std::vector<CLI::Option*>& options, const char* reason) {
    for (const CLI::Option* option : options) {
        if (option->count() > 0) {
            throw Error(fmt::format("{}: {}", option->get_name(), reason));
        }
    }
}

void check_view_options(ViewOptions& options) {
    RenderRequest& request = options.arguments.request;
    if (options.arguments.size.empty()) {
        options.arguments.size = "1280x720";
    }
    resolve_names(options.arguments);
    tonemap_from_name(request.tonemap);
    RenderSettings& settings = request.settings;
    if (settings.atlas_tile > 0) {
        throw Error("--atlas: a view shows one picture, not copies of it");
    }
    if (settings.sampler == SamplerKind::hammersley) {
        throw Error("--sampler hammersley: needs a known number of samples, and a view renders as many as "
                    "there is time for");
    }
    if (options.headless) {
        refuse_given(options.window_options, "works only with a window, not with --headless");
    } else {
        refuse_given(options.headless_options, "works only with --headless");
    }
    if (!options.output.empty()) {
        check_writable(options.output);
        refuse_inputs({options.output}, request);
    }
    if (!options.log.empty()) {
        refuse_inputs({options.log}, request);
    }
    request.device = options.device;
    request.threads = options.threads;
    request.validation = options.validation;
    settings.standard_error = true;
    settings.first_hit_layers = true;
}

/// Before the scene is loaded, which may take its time.
void require_display() {
#if DIPTYCH_VIEW
    check_display();
#else
    throw NoDevice(
        "view: this program was built without a window (DIPTYCH_VIEW=OFF); use view --headless, render --frames or "
        "render --live HOST:PORT");
#endif
}

int show(const ViewOptions& options, ShownPanel panel, LoadedScene scene) {
#if DIPTYCH_VIEW
    WindowOptions window;
    window.panel = panel;
    window.width = scene.request.settings.width;
    window.height = scene.request.settings.height;
    window.scale = options.scale;
    window.interface_scale = static_cast<float>(options.interface_scale);
    window.frames_per_second = options.frames_per_second;
    window.log = options.log;
    window.folder = options.folder;
    return show_window(window, std::move(scene));
#else
    static_cast<void>(options);
    static_cast<void>(panel);
    static_cast<void>(scene);
    return exit_no_device;  // require_display has said so
#endif
}

int run_view(ViewOptions options) {
    check_view_options(options);
    const ShownPanel panel = shown_panel_from_name(options.panel);
    if (!options.headless) {
        require_display();
    }
    LoadedScene scene = load_scene(options.arguments.request, 1);
    report_warnings(scene.scene->warnings);
    report_clips(*scene.scene, scene.request);
    if (!options.headless) {
        return show(options, panel, std::move(scene));
    }
    RenderSettings& settings = scene.request.settings;
    settings.width = std::max(1, static_cast<int>(std::lround(settings.width * options.scale)));
    settings.height = std::max(1, static_cast<int>(std::lround(settings.height * options.scale)));
    return run_headless({.panel = panel,
                         .frames = options.frames,
                         .frames_per_second = options.frames_per_second,
                         .output = options.output,
                         .json = options.json},
                        std::move(scene));
}

}  // namespace

void add_view(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("view", "Show a scene in a window, rendered while the camera moves");
    auto options = std::make_shared<ViewOptions>();
    RenderRequest& request = options->arguments.request;
    command->add_option("scene", request.scene, ".gltf or .glb file")->required();
    command->add_option("--panel", options->panel,
                        "Panels to show: vulkan, cpu, split or difference")
        ->capture_default_str();
    command->add_option("--fps", options->frames_per_second,
                        "Target frames per second; it sets the samples and the preview size of a frame")
        ->check(number_between(1, 1000))
        ->capture_default_str();
    command->add_option("--scale", options->scale, "Ratio of rendered to shown pixels, in each direction")
        ->check(number_between(0.05, 4))
        ->capture_default_str();
    command->add_flag("--headless", options->headless, "Measure the frame times of the view without a window");
    const auto with_headless = [&](CLI::Option* option) { options->headless_options.push_back(option); };
    with_headless(command->add_option("--frames", options->frames, "With --headless: number of frames")
                      ->check(CLI::Range(2U, 1000000U))
                      ->capture_default_str());
    with_headless(
        command->add_option("-o,--output", options->output,
                            "With --headless: file for the last frame, .png, .exr or .hdr"));
    with_headless(command->add_flag("--json", options->json, "With --headless: print the results as JSON"));
    options->window_options.push_back(
        command->add_option("--log", options->log, "File for a log with one line of JSON per event; - is stdout"));
    options->window_options.push_back(
        command->add_option("--shots", options->folder, "Folder for saved pictures")
            ->check(CLI::ExistingDirectory));
    options->window_options.push_back(command
                                          ->add_option("--interface-scale", options->interface_scale,
                                                       "Scale of text and buttons; default: the display's")
                                          ->check(number_between(0.5, 4)));
    command->add_option("--seed", request.settings.seed, "Seed of the cpu panel; the vulkan panel has the next one")
        ->capture_default_str();
    add_integrator_option(*command, options->arguments);
    add_scene_options(*command, options->arguments);
    command->add_option("--device", options->device, "Vulkan device, by index or name; default: the best");
    command->add_option("--threads", options->threads, "CPU threads; default: one per core")
        ->check(CLI::Range(1, 4096));
    command->add_flag("--validation", options->validation,
                      "Run Vulkan's validation layers; exit code 1 if they report anything");
    add_display_options(*command, request.exposure, request.tonemap, "for the window and saved .png files");
    command->footer(view_examples);
    command->callback([options, &run] { run = [options] { return run_view(*options); }; });
}

}  // namespace diptych::core::app
