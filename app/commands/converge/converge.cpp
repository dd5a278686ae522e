#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <filesystem>
#include <memory>

#include "clock.h"
#include "commands/command.h"
#include "commands/converge/page.h"
#include "commands/converge/pictures.h"
#include "commands/converge/plan.h"
#include "commands/converge/runner.h"
#include "commands/converge/summary.h"
#include "error.h"
#include "image/atomic_file.h"
#include "image/metrics.h"
#include "console/interrupt.h"
#include "render/film_statistics.h"
#include "render/metadata.h"
#include "console/report.h"
#include "session/scene_setup.h"
#include "console/step_line.h"

namespace diptych::app {

namespace {

constexpr const char* default_converge_size = "256";

constexpr const char* converge_examples = R"(Examples:
  diptych converge cornell.gltf -o report
  diptych converge scene.glb --methods cpu:path,vulkan:path,vulkan:restir --time 2 --size 640x360 -o report
  diptych converge cornell.gltf --methods cpu:path:independent,cpu:path:hammersley,cpu:path:sobol --spp-max 1024 -o samplers
  diptych converge scene.glb --methods vulkan:path --reference truth.exr --spp-max 4096 --runs 32 --json -o report
Renders every method --runs times, each run with a seed of its own, and measures it against the reference at 1, 2, 4, 8... samples a
pixel: error over samples and over time, its slope, what of it is bias, the time to a target. Open index.html of the folder when it is
done. Ctrl-C stops; the same command goes on from there. What the files hold is in docs/converge.md.)";

class Converge {
public:
    Converge(const ConvergeOptions& options, const Scene& scene, const std::vector<Method>& methods)
        : options_(options), scene_(scene), methods_(methods), state_(options.folder),
          line_(static_cast<int>(reference_blocks + methods.size() * (options.runs + 2))) {
        for (const Method& method : methods_) {
            runners_.push_back(std::make_unique<MethodRunner>(scene_, method));
        }
    }

    ConvergeState& state() { return state_; }

    /// False where `cancel` came before the end. What is finished is kept either way.
    bool measure(const std::atomic<bool>& cancel) {
        return find_limits(cancel) && find_reference(cancel) && render_runs(cancel) && render_pictures(cancel);
    }

    /// Writes what the results so far say; nothing where there are none yet.
    std::optional<Summary> report() {
        if (!reference_ || state_.rows().empty()) {
            return std::nullopt;
        }
        Summary summary = summarize_results(options_, methods_, *reference_, state_);
        json_ = summary_to_json(options_, summary, *reference_, state_);
        write_page_pictures(methods_, *reference_, options_.page_side, state_);
        write_file_atomically(state_.path("summary.json"), json_.dump(2) + "\n");
        write_file_atomically(state_.path("summary.csv"), summary_to_csv(summary));
        write_page(json_, state_);
        json_["plots"] = write_plots(json_, state_);
        return summary;
    }

    const nlohmann::ordered_json& json() const { return json_; }
    const Reference& reference() const { return *reference_; }

private:
    std::vector<std::uint32_t> counts_of(std::size_t method) const {
        std::vector<std::uint32_t> counts;
        for (std::uint32_t spp = 1; spp <= limits_[method]; spp *= 2) {
            counts.push_back(spp);
        }
        return counts;
    }

    bool find_limits(const std::atomic<bool>& cancel) {
        for (std::size_t i = 0; i < methods_.size(); ++i) {
            const nlohmann::ordered_json known = state_.latest("limit", methods_[i].name);
            std::uint32_t limit = std::bit_floor(options_.spp_max);
            if (!known.is_null()) {
                limit = known.at("spp_max");
            } else if (options_.seconds > 0) {
                line_.begin(methods_[i].name + ", how many samples fit the time");
                limit = runners_[i]->samples_within(options_.seconds, cancel);
                if (limit == 0) {
                    return false;
                }
                state_.append(
                    nlohmann::ordered_json{{"kind", "limit"}, {"method", methods_[i].name}, {"spp_max", limit}});
            }
            limits_.push_back(limit);
        }
        return true;
    }

    bool find_reference(const std::atomic<bool>& cancel) {
        const RenderSettings& settings = options_.arguments.request.settings;
        if (reference_is_file(options_)) {
            reference_ = load_reference(options_.reference, settings.width, settings.height);
            return true;
        }
        const Method method = plan_reference(options_, methods_);
        const std::uint32_t spp = *std::max_element(limits_.begin(), limits_.end());
        reference_ = make_reference(scene_, method, spp, state_, cancel, [&](std::uint32_t block) {
            line_.begin(fmt::format("reference by {}, block {} of {}", method.name, block + 1, reference_blocks));
        });
        return reference_.has_value();
    }

    bool render_runs(const std::atomic<bool>& cancel) {
        for (std::size_t i = 0; i < methods_.size(); ++i) {
            sums_.push_back(state_.load_sums(methods_[i].name));
        }
        for (std::uint32_t run = 0; run < options_.runs; ++run) {
            for (std::size_t i = 0; i < methods_.size(); ++i) {
                if (!render_run(i, run, cancel)) {
                    return false;
                }
            }
        }
        return true;
    }

    /// Lines and sums are two files, and an end between them leaves one a run behind: that one alone is then caught up.
    bool render_run(std::size_t index, std::uint32_t run, const std::atomic<bool>& cancel) {
        MethodRunner& runner = *runners_[index];
        const std::string& name = methods_[index].name;
        std::map<std::uint32_t, DeviationSums>& sums = sums_[index];
        const bool lacks_rows = run >= state_.runs(name);
        const bool lacks_sums = sums.empty() || run >= sums.begin()->second.runs;
        if (!lacks_rows && !lacks_sums) {
            return true;
        }
        line_.begin(fmt::format("{}, run {} of {}", name, run + 1, options_.runs));
        note_setup(runner);
        const std::uint32_t seed = methods_[index].seed_of(run);
        std::vector<ErrorRow> rows;
        std::map<std::uint32_t, std::vector<float>> deviations;
        const bool whole =
            runner.run(seed, counts_of(index), cancel,
                       [&](std::uint32_t spp, const Film& film, double device_seconds, double wall_seconds) {
                           rows.push_back(row_of(film, device_seconds, wall_seconds));
                           rows.back().method = name;
                           rows.back().run = run;
                           rows.back().seed = seed;
                           rows.back().spp = spp;
                           deviations[spp] = deviations_of(film);
                       });
        if (!whole) {
            return false;
        }
        if (lacks_sums) {
            for (const auto& [spp, values] : deviations) {
                sums[spp].add(values);
            }
            state_.save_sums(name, sums);
        }
        if (lacks_rows) {
            state_.append(rows);
        }
        return true;
    }

    bool render_pictures(const std::atomic<bool>& cancel) {
        const double seconds = summarize_results(options_, methods_, *reference_, state_).equal_seconds;
        for (const std::unique_ptr<MethodRunner>& runner : runners_) {
            line_.begin(fmt::format("{}, its picture", runner->method().name));
            if (!make_picture(*runner, seconds, *reference_, state_, cancel)) {
                return false;
            }
        }
        return true;
    }

    void note_setup(MethodRunner& runner) {
        if (!runner.noted) {
            const SetupCosts costs = runner.costs();
            runner.noted = true;
            state_.append(nlohmann::ordered_json{{"kind", "setup"},
                                                 {"method", runner.method().name},
                                                 {"device", runner.device()},
                                                 {"pack_seconds", costs.pack_seconds},
                                                 {"build_seconds", costs.build_seconds},
                                                 {"compile_seconds", costs.compile_seconds},
                                                 {"bytes", costs.bytes}});
        }
    }

    ErrorRow row_of(const Film& film, double device_seconds, double wall_seconds) const {
        const Difference difference = compare_images(develop(film), reference_->image);
        const FilmTotals totals = film_totals(film);
        ErrorRow row;
        row.device_seconds = device_seconds;
        row.wall_seconds = wall_seconds;
        row.mse = difference.mse;
        row.relmse = difference.relmse;
        row.relmse_trimmed = difference.relmse_trimmed;
        row.trimmed_energy = difference.trimmed_energy;
        row.nonfinite = totals.nonfinite;
        row.rays = totals.rays;
        return row;
    }

    std::vector<float> deviations_of(const Film& film) const {
        const std::vector<float>& truth = reference_->image.color.data;
        std::vector<float> deviations(truth.size());
        for (std::size_t i = 0; i < film.pixels.size(); ++i) {
            const Rgb mean = pixel_mean(film.pixels[i]);
            for (std::size_t channel = 0; channel < 3; ++channel) {
                deviations[3 * i + channel] = static_cast<float>(mean[channel] - truth[3 * i + channel]);
            }
        }
        return deviations;
    }

    const ConvergeOptions& options_;
    const Scene& scene_;
    const std::vector<Method>& methods_;
    ConvergeState state_;
    StepLine line_;
    std::vector<std::unique_ptr<MethodRunner>> runners_;
    std::vector<std::uint32_t> limits_;  // samples a pixel, of each method
    std::vector<std::map<std::uint32_t, DeviationSums>> sums_;
    std::optional<Reference> reference_;
    nlohmann::ordered_json json_;
};

int run_converge(ConvergeOptions options) {
    if (options.arguments.size.empty() && !reference_is_file(options)) {
        options.arguments.size = default_converge_size;
    }
    if (options.arguments.size.empty()) {
        const Image image = read_image(options.reference).color;
        options.arguments.size = fmt::format("{}x{}", image.width, image.height);
    }
    check_converge_options(options);
    const Stopwatch loading;
    const Scene scene = prepare_scene(options.arguments);
    const double load_seconds = loading.seconds();
    const std::vector<Method> methods = plan_methods(options);
    claim_folder(options, plan_to_json(options, methods));
    bool whole = false;
    std::optional<Summary> summary;
    nlohmann::ordered_json json;
    {
        Converge converge(options, scene, methods);
        if (converge.state().latest("scene").is_null()) {
            converge.state().append(nlohmann::ordered_json{{"kind", "scene"}, {"load_seconds", load_seconds}});
        }
        {
            InterruptGuard interrupt;
            whole = converge.measure(interrupt.requested());
        }
        summary = converge.report();
        json = converge.json();
        if (summary && !options.json) {
            print_summary(options, *summary, converge.reference());
        }
    }
    if (summary && options.json) {
        json["interrupted"] = !whole;
        print_json(json);
    }
    if (!whole) {
        report_error(fmt::format("{}: interrupted; the same command goes on from here", options.folder));
    }
    return whole ? exit_done : exit_interrupted;
}

/// The command line as typed.
std::string typed(const CLI::App& command) {
    std::string text = "diptych " + command.get_name();
    for (const CLI::Option* option : command.get_options()) {
        if (option->count() == 0 || option->get_name() == "--json") {
            continue;
        }
        if (!option->get_positional()) {
            text += " " + option->get_name();
        }
        if (option->get_items_expected_max() > 0) {
            const bool listed = option->get_delimiter() != '\0';
            text += " " +
                    (listed ? shell_quoted(fmt::format("{}", fmt::join(option->results(), ",")))
                            : fmt::format("{}", fmt::join(option->results(), fmt::format(" {} ", option->get_name()))));
        }
    }
    return text;
}

}  // namespace

void add_converge(CLI::App& app, Run& run) {
    CLI::App* command =
        app.add_subcommand("converge", "Measure how the error falls over samples and time, and report it");
    auto options = std::make_shared<ConvergeOptions>();
    RenderRequest& request = options->arguments.request;
    command->add_option("scene", request.scene, ".gltf or .glb file")->required();
    command
        ->add_option("--methods", options->methods,
                     "Comma-separated BACKEND:INTEGRATOR[:SAMPLER], such as vulkan:path or cpu:direct:independent; or "
                     "oracle[:MODE]")
        ->delimiter(',')
        ->capture_default_str();
    CLI::Option* spp =
        command->add_option("--spp-max", options->spp_max, "Most samples a pixel of a run; a power of two, or less")
            ->check(CLI::Range(1U, 1U << 24U))
            ->capture_default_str();
    command
        ->add_option("--time", options->seconds,
                     "Instead: as many samples, a power of two, as each method renders in so many seconds")
        ->check(CLI::Range(0.001, 1e9))
        ->check(finite_number())
        ->excludes(spp);
    command->add_option("--runs", options->runs, "Renders of each method, with seeds of their own")
        ->check(CLI::Range(2, 4096))
        ->capture_default_str();
    command
        ->add_option("--reference", options->reference,
                     "A picture; or BACKEND:INTEGRATOR[:SAMPLER], to be rendered with 16 times the samples; auto: "
                     "`path` where it is "
                     "not itself measured")
        ->capture_default_str();
    command
        ->add_option("--target-relmse", options->target_relmse,
                     "Tell the time until this relMSE; else what half of the methods reach")
        ->check(positive_number());
    command
        ->add_option("--picture-time", options->picture_seconds,
                     "Seconds of rendering that the pictures compare; by default the shortest of the methods' runs")
        ->check(positive_number());
    command
        ->add_option("--page-side", options->page_side,
                     "The page's pictures are thinned to at most so many pixels a side")
        ->check(CLI::Range(16, 32768))
        ->capture_default_str();
    command->add_option("--seed", options->seed, "Of all renders, whose own seeds derive from it")
        ->capture_default_str();
    add_scene_options(*command, options->arguments);
    command->add_option("--device", request.device, "Vulkan device by index or name; the best by default");
    command->add_option("--threads", request.threads, "Threads of cpu or oracle; one a core by default")
        ->check(CLI::Range(1, 4096));
    command->add_flag("--validation", request.validation,
                      "Run Vulkan's validation layers; exit 1 if they have anything to say");
    command->add_option("-o,--output", options->folder, "Folder of the results; index.html is the page")->required();
    command->add_flag("--json", options->json, "Results as JSON on stdout");
    command->footer(converge_examples);
    command->callback([options, command, &run] {
        options->command = typed(*command);
        run = [options] { return run_converge(*options); };
    });
}

}  // namespace diptych::app
