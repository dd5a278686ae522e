#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <memory>
#include <mutex>
#include <random>

#include "clock.h"
#include "commands/command.h"
#include "error.h"
#include "console/output.h"
#include "commands/arguments/device_loss.h"
#include "console/interrupt.h"
#include "settings/names.h"
#include "console/report.h"
#include "pose/pose.h"
#include "session/open_session.h"
#include "session/scene_setup.h"
#include "commands/verify/paired.h"
#include "commands/verify/random.h"
#include "commands/verify/report.h"
#include "commands/verify/sequence.h"

namespace diptych::core::app {

namespace {

constexpr const char* default_verify_size = "128";

constexpr const char* verify_examples = R"(Examples:
  diptych verify cornell.gltf
  diptych verify cornell.gltf --backends cpu --integrators brdf,direct --against cpu/path --spp 256 -o figures
  diptych verify scene.glb --backends vulkan --against cpu --time 600 --require-pass --json
  diptych verify cornell.gltf --fresh-seeds --time 3600
  diptych verify cornell.gltf --common-seeds --time 60 --require-pass
  diptych verify cornell.gltf --paired --spp 16
  diptych verify --random 100 --seed 1 -o failures
  diptych verify moving.gltf --backends cpu --integrators restir --against cpu/path --frame 0,1,2,4,8,16 --spp 256
Renders each side --runs times, each run with its own seed, and compares the means of the runs by Welch's test.
There are three tests: of the image, of all tiles together (Fisher), and of the tile with the smallest p-value.
FAIL: the difference is significant at --alpha, over all pairs together. PASS: it is not, and the confidence
intervals are narrow enough to detect a bias. INCONCLUSIVE: neither; a line names the command that gives a verdict.
The exit code is 1 on FAIL, and with --require-pass on INCONCLUSIVE too.
With --frame, --start or --orbit the scene moves as in render --frames, and each tested frame counts as a pair. For
each run, restir renders the sequence from frame 0 on, --spp / --frame-spp times with different seeds. Other
integrators render only the tested frames.
--random tests each scene with five integrators: cpu against the oracle, and vulkan against cpu with common seeds.
Scenes of even seeds move; there ris and restir are tested against path at each of five frames. A scene that fails
is shrunk and written to the folder -o.)";

/// "vulkan/path: run 3 of 32", in place on a terminal, elsewhere at each doubling of the time from two seconds on.
class RunLine {
public:
    explicit RunLine(std::uint32_t runs) : runs_(runs), terminal_(isatty(STDERR_FILENO) == 1) {}
    ~RunLine() {
        if (terminal_ && shown_) {
            print_message("\r\x1b[K");
        }
    }
    RunLine(const RunLine&) = delete;
    RunLine& operator=(const RunLine&) = delete;

    /// From any thread.
    void show(const SideName& side, std::uint32_t run) {
        const std::lock_guard lock(mutex_);
        if (side.backend == "vulkan") {
            on_device_ = fmt::format("run {} of {} of {}", run + 1, runs_, text_of(side));
        }
        const double seconds = watch_.seconds();
        if (seconds < next_) {
            return;
        }
        next_ = terminal_ ? seconds + 0.1 : 2 * seconds;
        shown_ = true;
        print_message("{}{}: run {} of {}, {:.0f} s{}", terminal_ ? "\r" : "", text_of(side), run + 1, runs_,
                      seconds, terminal_ ? "\x1b[K" : "\n");
    }

    /// The last run that a Vulkan device was asked for.
    std::string on_device() {
        const std::lock_guard lock(mutex_);
        return on_device_;
    }

private:
    std::mutex mutex_;
    std::uint32_t runs_;
    std::string on_device_ = "its first use";
    bool terminal_;
    bool shown_ = false;
    double next_ = 2;
    Stopwatch watch_;
};

void check_verify_options(VerifyOptions& options) {
    device_loss_policy(options.on_device_lost, false, options.arguments.request);
    resolve_frames(options);
    if (options.arguments.size.empty()) {
        options.arguments.size = default_verify_size;
    }
    // Which panels heed --device and --threads is plan_pairs' to say.
    RenderArguments names = options.arguments;
    names.request.device.clear();
    names.request.threads = 0;
    names.request.validation = false;
    resolve_names(names);
    const RenderRequest typed = options.arguments.request;
    options.arguments.request.settings = names.request.settings;
    if (typed.settings.sampler == SamplerKind::hammersley ||
        names.request.settings.sampler == SamplerKind::hammersley) {
        if (options.seconds > 0) {
            throw Error("--sampler hammersley: needs a known number of samples; give --spp");
        }
    }
    if (!options.output.empty()) {
        prepare_folder(options.output);
    }
}

int exit_code_of(Verdict verdict, bool require_pass) {
    const bool fails = verdict == Verdict::fail || (require_pass && verdict == Verdict::inconclusive);
    return fails ? exit_check_failed : exit_done;
}

/// --paired: the first backend against the reference, or two backends with one another.
int verify_paths(const VerifyOptions& options) {
    PairArguments pair;
    pair.backends = options.backends;
    if (pair.backends.size() == 1) {
        pair.backends.insert(pair.backends.begin(), options.against);
    }
    const RenderRequest& request = options.arguments.request;
    pair.device = request.device;
    pair.threads = request.threads;
    pair.validation = request.validation;
    PairedOptions paired;
    paired.integrators.clear();
    for (const std::string& name : options.integrators) {
        paired.integrators.push_back(integrator_from_name(name));
    }
    paired.spp = options.spp;
    paired.folder = options.output;
    paired.json = options.json;
    paired.require_pass = options.require_pass;
    RenderArguments arguments = options.arguments;
    arguments.request.settings.seed = options.seed;
    return run_paired(arguments, pair, paired);
}

int run_verify(VerifyOptions options) {
    if (options.random > 0) {
        return verify_random(options);
    }
    if (!options.shrink) {
        throw Error("--no-shrink: works only with --random");
    }
    if (options.moving || options.still) {
        throw Error("--moving, --still: work only with --random");
    }
    if (options.arguments.request.scene.empty()) {
        throw Error("verify: needs a scene, .gltf or .glb, or --random N");
    }
    check_verify_options(options);
    if (options.paired) {
        return verify_paths(options);
    }
    const std::vector<PairName> pairs = plan_pairs(options);
    const Scene scene = prepare_scene(options.arguments);
    if (moves(scene) && options.frames.empty()) {
        report_warning(
            fmt::format("{}: its animations are not played and it is shown at rest; give --frame or --start",
                        scene.name));
    }
    if (!options.frames.empty()) {
        report_clips(scene, options.arguments.request);
    }
    const std::uint32_t seed =
        options.fresh_seeds && !options.seed_given ? static_cast<std::uint32_t>(std::random_device{}()) : options.seed;
    std::optional<SuiteResult> suite;
    {
        InterruptGuard interrupt;
        RunLine line(options.runs);
        const VerifySubject subject{scene, options.arguments.request, open_requested,
                                    device_loss_policy(options.on_device_lost, false, options.arguments.request)};
        try {
            suite = run_suite(options, subject, pairs, seed, interrupt.requested(),
                              [&](const SideName& side, std::uint32_t run) { line.show(side, run); });
        } catch (const DeviceLost& error) {
            throw DeviceLost(fmt::format("{}: lost its device in {}, there is no verdict; --on-device-lost retry "
                                         "repeats such a run: {}",
                                         options.arguments.request.scene, line.on_device(), error.what()));
        }
    }
    if (!suite) {
        report_error(fmt::format("{}: interrupted before all runs were done; there is no verdict",
                                 options.arguments.request.scene));
        return interrupt_exit_code();
    }
    const std::vector<std::string> figures =
        options.output.empty() ? std::vector<std::string>() : write_suite_figures(options.output, *suite);
    if (options.json) {
        nlohmann::ordered_json json = suite_to_json(options, *suite);
        json["figures"] = figures;
        print_json(json);
    } else {
        print_suite(options, *suite);
    }
    if (suite->interrupted) {
        report_error(fmt::format("{}: interrupted; {} of {} pairs have a verdict", options.arguments.request.scene,
                                 suite->pairs.size(), pairs.size()));
        return interrupt_exit_code();
    }
    return exit_code_of(verdict_of(*suite), options.require_pass);
}

}  // namespace

void add_verify(CLI::App& app, Run& run) {
    CLI::App* command =
        app.add_subcommand("verify", "Test whether backends and integrators converge to the same image");
    auto options = std::make_shared<VerifyOptions>();
    RenderRequest& request = options->arguments.request;
    command->add_option("scene", request.scene, ".gltf or .glb file");
    command->add_option("--integrators", options->integrators, "Integrators under test, comma-separated")
        ->delimiter(',')
        ->capture_default_str();
    command->add_option("--backends", options->backends, "Backends under test, comma-separated")
        ->delimiter(',')
        ->capture_default_str();
    command
        ->add_option(
            "--against", options->against,
            "Reference: BACKEND (with the same integrator), BACKEND/INTEGRATOR, oracle or oracle/MODE")
        ->capture_default_str();
    CLI::Option* runs = command->add_option("--runs", options->runs, "Runs per side, each with its own seed")
                            ->check(CLI::Range(2, 4096))
                            ->capture_default_str();
    CLI::Option* spp = command->add_option("--spp", options->spp, "Samples per pixel of each run")
                           ->check(CLI::Range(1U, 1U << 30U))
                           ->capture_default_str();
    CLI::Option* against_spp =
        command
            ->add_option(
                "--against-spp", options->against_spp,
                "Samples per pixel of each run of the reference; default: --spp")
            ->check(CLI::Range(1U, 1U << 30U));
    CLI::Option* time = command
                            ->add_option("--time", options->seconds,
                                         "Seconds in which to double the samples until every pair has enough power")
                            ->check(CLI::Range(0.001, 1e9))
                            ->check(finite_number())
                            ->excludes(spp)
                            ->excludes(against_spp);
    command->add_option("--tile", options->tile, "Side of a tile, pixels")
        ->check(CLI::Range(1, 32768))
        ->capture_default_str();
    command->add_option("--alpha", options->alpha, "Probability of a false FAIL, over all pairs together")
        ->check(CLI::Range(1e-12, 0.5))
        ->check(finite_number())
        ->capture_default_str();
    command
        ->add_option("--max-half-width", options->max_half_width,
                     "PASS needs a 95 % half-width of the image mean of at most this, percent")
        ->check(positive_number())
        ->capture_default_str();
    command
        ->add_option("--max-tile-half-width", options->max_tile_half_width,
                     "PASS needs a 95 % half-width of at most this in half of the tiles, percent")
        ->check(positive_number())
        ->capture_default_str();
    CLI::Option* seed = command->add_option("--seed", options->seed, "Seed that the seeds of all runs derive from")
                            ->capture_default_str();
    CLI::Option* fresh = command->add_flag(
        "--fresh-seeds", options->fresh_seeds,
        "Draw a random seed if --seed is not given, and test again what fails, with four times the samples");
    CLI::Option* paired =
        command
            ->add_flag(
                "--paired", options->paired,
                "Compare path by path instead: both backends trace each path from the same random numbers")
            ->excludes(runs)
            ->excludes(against_spp)
            ->excludes(time)
            ->excludes(fresh);
    command
        ->add_flag("--common-seeds", options->common_seeds,
                   "Give run k of both sides one seed and test the differences, whose noise is small if paths agree")
        ->excludes(paired);
    add_sequence_options(*command, *options, *paired);
    command->add_flag("--require-pass", options->require_pass, "Exit code 1 on INCONCLUSIVE too");
    add_scene_options(*command, options->arguments);
    command->add_option("--device", request.device, "Vulkan device, by index or name; default: the best");
    command->add_option("--threads", request.threads, "CPU threads; default: one per core")->check(CLI::Range(1, 4096));
    command->add_flag("--validation", request.validation, "Run Vulkan's validation layers");
    command->add_option("-o,--output", options->output, "Folder for a map and a histogram (SVG) of each pair's p-values");
    command->add_flag("--json", options->json, "Print the results as JSON");
    add_device_loss_option(*command, options->on_device_lost, false)->excludes(paired);
    add_random_option(*command, *options);
    command->footer(verify_examples);
    options->command = command;
    command->callback([options, seed, &run] {
        options->seed_given = seed->count() > 0;
        run = [options] { return run_verify(*options); };
    });
}

}  // namespace diptych::core::app
