#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "clock.h"
#include "commands/arguments/arguments.h"
#include "commands/command.h"
#include "error.h"
#include "session/open_session.h"
#include "settings/names.h"
#include "console/report.h"
#include "session/scene_setup.h"
#include "console/step_line.h"

namespace diptych::app {

namespace {

constexpr const char* bench_examples = R"(Examples:
  diptych bench cornell.gltf --backend cpu
  diptych bench street.glb --backend vulkan --size 1920x1080 --integrators brdf,path --frames 20 --json
  diptych bench street.glb --backend vulkan --integrators direct,ris,restir --max-depth 1
Medians over the frames; restir's frames follow one another. The integrators take turns, so that all ratios come from one run under the same conditions.)";

// Frames that do not count: two at least, since restir's first has none before it to reuse, and as many as a device
// needs to leave its clocks of rest.
constexpr std::uint32_t least_warm_up = 2;
constexpr std::uint32_t most_warm_up = 1024;
constexpr double warm_up_seconds = 0.5;

struct BenchOptions {
    RenderArguments arguments;
    std::vector<std::string> integrators{"brdf", "direct", "path"};
    std::uint32_t spp = 1;
    int frames = 9;
    bool json = false;
};

/// One integrator on its own renderer, and the times of its frames.
struct Entry {
    Integrator integrator = Integrator::path;
    std::unique_ptr<Session> session;
    std::vector<double> frame_seconds;
    std::optional<TraversalBench> traversal;        // of integrators that take each sample by itself
    std::vector<std::vector<double>> pass_seconds;  // of each pass, its frames
    double rays_per_frame = 0;
    std::uint32_t next_frame = 0;
};

struct Figures {
    double milliseconds = 0;  // one sample a pixel
    double samples_per_second = 0;
    double rays_per_second = 0;
    double bare_rays_per_second = 0;   // 0 where that is not measured
    double share_of_bare = 0;          // likewise
    double cost_relative_to_brdf = 0;  // a sample; 0 where brdf was not measured
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

std::vector<Entry> make_entries(BenchOptions& options, const Scene& scene, StepLine& line) {
    std::vector<Entry> entries;
    for (const std::string& name : options.integrators) {
        line.begin(name + ", building");
        RenderRequest request = options.arguments.request;
        request.settings.integrator = integrator_from_name(name);
        request.settings.sample_count = options.spp * (most_warm_up + static_cast<std::uint32_t>(options.frames));
        Entry entry;
        entry.integrator = request.settings.integrator;
        entry.session = std::make_unique<Session>(open_session(scene, request));
        entries.push_back(std::move(entry));
    }
    return entries;
}

void measure(Entry& entry, std::uint32_t spp) {
    const std::atomic<bool> never = false;
    const double before = entry.session->renderer().device_seconds();
    const std::vector<PassTime> passes_before = entry.session->renderer().pass_times();
    entry.session->render(entry.next_frame++ * spp, spp, never);
    entry.frame_seconds.push_back(entry.session->renderer().device_seconds() - before);
    const std::vector<PassTime> passes = entry.session->renderer().pass_times();
    entry.pass_seconds.resize(passes.size());
    for (std::size_t i = 0; i < passes.size(); ++i) {
        entry.pass_seconds[i].push_back(passes[i].seconds - passes_before[i].seconds);
    }
}

void warm_up(Entry& entry, std::uint32_t spp) {
    const Stopwatch watch;
    while (entry.next_frame < least_warm_up || (entry.next_frame < most_warm_up && watch.seconds() < warm_up_seconds)) {
        measure(entry, spp);
    }
    entry.frame_seconds.clear();
    entry.pass_seconds.clear();
    entry.rays_per_frame = -static_cast<double>(film_totals(entry.session->film()).rays);
}

void run_rounds(std::vector<Entry>& entries, const BenchOptions& options, StepLine& line) {
    for (Entry& entry : entries) {
        line.begin(fmt::format("{}, warming up", name_of(entry.integrator)));
        warm_up(entry, options.spp);
    }
    for (int frame = 0; frame < options.frames; ++frame) {
        for (Entry& entry : entries) {
            line.begin(fmt::format("{}, frame {}", name_of(entry.integrator), frame + 1));
            measure(entry, options.spp);
        }
    }
    for (Entry& entry : entries) {
        entry.rays_per_frame += static_cast<double>(film_totals(entry.session->film()).rays);
        entry.rays_per_frame /= options.frames;
    }
    for (Entry& entry : entries) {
        if (resamples(entry.integrator)) {
            continue;
        }
        line.begin(fmt::format("{}, bare traversal", name_of(entry.integrator)));
        entry.traversal = entry.session->renderer().bench_traversal(options.spp);  // medians of its own repeats
    }
}

std::vector<Figures> evaluate(const std::vector<Entry>& entries, const BenchOptions& options) {
    const RenderSettings& settings = options.arguments.request.settings;
    const double pixels = static_cast<double>(settings.width) * settings.height;
    double brdf_seconds = 0;
    for (const Entry& entry : entries) {
        brdf_seconds = entry.integrator == Integrator::brdf ? median(entry.frame_seconds) : brdf_seconds;
    }
    std::vector<Figures> all;
    for (const Entry& entry : entries) {
        const double seconds = median(entry.frame_seconds);
        Figures figures;
        figures.milliseconds = 1000 * seconds / options.spp;
        figures.samples_per_second = pixels * options.spp / seconds;
        figures.rays_per_second = entry.rays_per_frame / seconds;
        if (entry.traversal) {
            figures.bare_rays_per_second = static_cast<double>(entry.traversal->rays) / entry.traversal->bare_seconds;
            figures.share_of_bare = entry.traversal->bare_seconds / entry.traversal->integrator_seconds;
        }
        figures.cost_relative_to_brdf = brdf_seconds > 0 ? seconds / brdf_seconds : 0;
        all.push_back(figures);
    }
    return all;
}

/// A sample's, each the median over the frames.
std::vector<PassTime> median_passes(const Entry& entry, std::uint32_t spp) {
    std::vector<PassTime> passes = entry.session->renderer().pass_times();
    for (std::size_t i = 0; i < passes.size(); ++i) {
        passes[i].seconds = median(entry.pass_seconds[i]) / spp;
    }
    return passes;
}

nlohmann::ordered_json passes_to_json(const Entry& entry, std::uint32_t spp) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const PassTime& pass : median_passes(entry, spp)) {
        json.push_back({{"pass", pass.pass}, {"milliseconds", 1000 * pass.seconds}});
    }
    return json;
}

void print_bench(const std::vector<Entry>& entries, const std::vector<Figures>& all, const RenderSettings& settings,
                 std::uint32_t spp) {
    fmt::print("{} at {}x{}, {}\n", entries.front().session->renderer().backend(), settings.width, settings.height,
               entries.front().session->renderer().device());
    fmt::print("{:<10} {:>10} {:>12} {:>10} {:>12} {:>10} {:>10}\n", "integrator", "ms/frame", "Msamples/s", "Mray/s",
               "bare Mray/s", "of bare", "of brdf");
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Figures& figures = all[i];
        const std::string relative =
            figures.cost_relative_to_brdf > 0 ? fmt::format("{:.2f}x", figures.cost_relative_to_brdf) : "-";
        const bool bare = entries[i].traversal.has_value();
        fmt::print("{:<10} {:>10.3f} {:>12.3f} {:>10.2f} {:>12} {:>10} {:>10}\n", name_of(entries[i].integrator),
                   figures.milliseconds, figures.samples_per_second / 1e6, figures.rays_per_second / 1e6,
                   bare ? fmt::format("{:.2f}", figures.bare_rays_per_second / 1e6) : "-",
                   bare ? fmt::format("{:.1f}%", 100 * figures.share_of_bare) : "-", relative);
        for (const PassTime& pass : median_passes(entries[i], spp)) {
            fmt::print("  {:<18} {:>10.3f}\n", pass.pass, 1000 * pass.seconds);
        }
    }
}

nlohmann::ordered_json to_json(const std::vector<Entry>& entries, const std::vector<Figures>& all,
                               const BenchOptions& options) {
    const RenderSettings& settings = options.arguments.request.settings;
    nlohmann::ordered_json json;
    json["scene"] = options.arguments.request.scene;
    json["backend"] = entries.front().session->renderer().backend();
    json["device"] = entries.front().session->renderer().device();
    json["width"] = settings.width;
    json["height"] = settings.height;
    json["spp"] = options.spp;
    json["frames"] = options.frames;
    json["integrators"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Figures& figures = all[i];
        const RendererCosts costs = entries[i].session->renderer().costs();
        const auto relative = figures.cost_relative_to_brdf > 0 ? nlohmann::ordered_json(figures.cost_relative_to_brdf)
                                                                : nlohmann::ordered_json();
        const auto bare = [&](double value) {
            return entries[i].traversal ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
        };
        json["integrators"].push_back({{"integrator", name_of(entries[i].integrator)},
                                       {"milliseconds", figures.milliseconds},
                                       {"samples_per_second", figures.samples_per_second},
                                       {"rays_per_second", figures.rays_per_second},
                                       {"bare_rays_per_second", bare(figures.bare_rays_per_second)},
                                       {"share_of_bare", bare(figures.share_of_bare)},
                                       {"cost_relative_to_brdf", relative},
                                       {"build_seconds", costs.build_seconds},
                                       {"compile_seconds", costs.compile_seconds},
                                       {"passes", passes_to_json(entries[i], options.spp)},
                                       {"bytes", costs.bytes}});
    }
    return json;
}

int run_bench(BenchOptions options) {
    resolve_names(options.arguments);
    if (options.arguments.request.backend == "oracle") {
        throw Error("--backend oracle: bench measures the panels, cpu and vulkan");
    }
    refuse_idle_resampling_options(options.arguments,
                                   std::any_of(options.integrators.begin(), options.integrators.end(),
                                               [](const auto& name) { return resamples(integrator_from_name(name)); }));
    const Scene scene = prepare_scene(options.arguments);
    std::vector<Entry> entries;
    {
        // Building, warming up, the frames and the bare traversal of each.
        StepLine line(static_cast<int>(options.integrators.size()) * (options.frames + 3));
        entries = make_entries(options, scene, line);
        run_rounds(entries, options, line);
    }
    const std::vector<Figures> figures = evaluate(entries, options);
    if (options.json) {
        print_json(to_json(entries, figures, options));
    } else {
        print_bench(entries, figures, options.arguments.request.settings, options.spp);
    }
    return exit_done;
}

}  // namespace

void add_bench(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("bench", "Measure how fast a backend renders a scene");
    auto options = std::make_shared<BenchOptions>();
    command->add_option("scene", options->arguments.request.scene, ".gltf or .glb file")->required();
    command->add_option("--integrators", options->integrators, "Those to measure")
        ->delimiter(',')
        ->capture_default_str();
    command->add_option("--spp", options->spp, "Samples a pixel in one frame")
        ->check(CLI::Range(1U, 65536U))
        ->capture_default_str();
    command->add_option("--frames", options->frames, "Repeats, of which the median counts")
        ->check(CLI::Range(5, 10000))
        ->capture_default_str();
    command->add_option("--seed", options->arguments.request.settings.seed, "Another seed, other noise")
        ->capture_default_str();
    add_scene_options(*command, options->arguments);
    add_backend_options(*command, options->arguments);
    command->add_flag("--json", options->json, "Results as JSON on stdout");
    command->footer(bench_examples);
    command->callback([options, &run] { run = [options] { return run_bench(*options); }; });
}

}  // namespace diptych::app
