#include "diptych/converge.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "image/image_file.h"
#include "library/impl.h"
#include "library/version.h"
#include "measure/converge/measurement.h"
#include "measure/converge/page.h"
#include "measure/converge/pictures.h"
#include "measure/converge/plan.h"
#include "measure/converge/report.h"
#include "oracle_renderer/oracle_renderer.h"

DIPTYCH_BEGIN

namespace {

namespace fs = std::filesystem;

constexpr int page_side = 512;  // of a picture within the page, at most

/// Where the engine keeps what is finished; it goes when this does.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string pattern = (fs::temp_directory_path() / "diptych-converge-XXXXXX").string();
        if (::mkdtemp(pattern.data()) == nullptr) {
            throw Error(pattern + ": cannot make a folder");
        }
        path_ = pattern;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    const std::string& path() const { return path_; }

private:
    std::string path_;
};

core::ConvergeSettings settings_of(const ConvergeOptions& options) {
    constexpr std::uint32_t most_runs = 4096, most_spp = 1U << 24U;
    if (options.runs < 2 || options.runs > most_runs || options.spp_max < 1 || options.spp_max > most_spp) {
        throw SettingError(fmt::format("converge: runs is {} and spp_max {}; they have to be 2 to {} and 1 to {}",
                                       options.runs, options.spp_max, most_runs, most_spp));
    }
    for (const auto& [name, value] : {std::pair("seconds", options.seconds), {"target_relmse", options.target_relmse},
                                      {"picture_seconds", options.picture_seconds}}) {
        if (!std::isfinite(value) || value < 0) {
            throw SettingError(fmt::format("converge: {} is {:g}; it has to be finite and not negative", name, value));
        }
    }
    if (options.methods.empty()) {
        throw SettingError("converge: there are no methods");
    }
    core::ConvergeSettings settings;
    settings.runs = options.runs;
    settings.spp_max = options.spp_max;
    settings.seconds = options.seconds;
    settings.picture_seconds = options.picture_seconds;
    settings.target_relmse = options.target_relmse;
    settings.maker.program = program_version();
    return settings;
}

void check_mode(const core::Method& method) {
    if (method.request.backend == "oracle") {
        core::oracle_mode_from_name(method.request.oracle_mode);
    }
}

/// Plans what is rendered. What a name cannot be is a setting's fault.
core::ConvergeSubject subject_of(const ConvergeOptions& options, const core::Scene& content,
                                 const core::RenderRequest& request) {
    core::ConvergeSubject subject{content, {}, {}, {}, open_measured};
    try {
        subject.methods = core::plan_methods(options.methods, request, options.settings.seed, options.runs);
        std::for_each(subject.methods.begin(), subject.methods.end(), check_mode);
        const bool planned = options.reference == "auto" || core::names_method(options.reference);
        if (planned && !options.reference_film) {
            subject.reference =
                core::plan_reference(options.reference, request, options.settings.seed, subject.methods);
            check_mode(*subject.reference);
        }
    } catch (const core::Error& error) {
        throw SettingError(error.what());
    }
    if (options.reference_film) {
        const FilmData& film = Impl::data(*options.reference_film);
        core::LayeredImage image = film.developed;
        image.metadata = film.metadata;
        subject.given_reference =
            core::checked_reference(image, film.name(), request.settings.width, request.settings.height);
    } else if (!subject.reference) {
        subject.given_reference =
            core::load_reference(options.reference, request.settings.width, request.settings.height, 0);
    }
    return subject;
}

Estimate result_of(const core::Interval& interval) {
    return {interval.value, interval.low, interval.high};
}

BiasEstimate result_of(const core::BiasSquared& bias) {
    return {bias.value, bias.standard_error, bias.p, bias.heavy};
}

ConvergePoint result_of(const core::CheckpointSummary& point) {
    return {point.spp,
            point.device_seconds,
            point.wall_seconds,
            result_of(point.mse),
            result_of(point.relmse),
            result_of(point.relmse_trimmed),
            point.trimmed_energy,
            point.mse_net,
            point.relmse_net,
            point.efficiency,
            result_of(point.bias),
            result_of(point.relative_bias),
            point.nonfinite};
}

ConvergeMethod result_of(const core::MethodSummary& method) {
    ConvergeMethod out;
    out.method = method.method->name;
    out.device = method.setup ? method.setup->device : "";
    out.runs = method.runs;
    for (const core::CheckpointSummary& point : method.checkpoints) {
        out.points.push_back(result_of(point));
    }
    out.slope_mse = result_of(method.slope_mse);
    out.slope_relmse = result_of(method.slope_relmse);
    out.bias_p = method.bias_p;
    out.bias_significant = method.bias_p < core::bias_alpha;
    out.bias_text = method.bias_text;
    out.target = static_cast<TargetTime>(method.to_target.kind);
    out.target_seconds = method.to_target.seconds;
    return out;
}

static_assert(static_cast<int>(core::TargetTime::Kind::unknown) == static_cast<int>(TargetTime::unknown));

ConvergeTable table_of(const core::ConvergeSummary& summary) {
    ConvergeTable table;
    for (const core::SummaryColumn& column : core::summary_columns()) {
        table.columns.push_back({column.name, {}});
    }
    for (const core::MethodSummary& method : summary.methods) {
        for (const core::CheckpointSummary& point : method.checkpoints) {
            table.method.push_back(method.method->name);
            for (std::size_t i = 0; i < table.columns.size(); ++i) {
                table.columns[i].values.push_back(core::summary_columns()[i].value(point));
            }
        }
    }
    return table;
}

}  // namespace

ConvergeResult converge(const Scene& scene, const ConvergeOptions& options) {
    return guarded([&] {
        const core::ConvergeSettings settings = settings_of(options);
        const std::shared_ptr<const core::Scene> content = Impl::data(scene).snapshot();
        check(options.settings, content->cameras.size());
        core::RenderRequest request = measured_request(*content, options.settings, options.device, options.threads);
        request.scene = content->name.empty() ? "scene" : content->name;
        const core::ConvergeSubject subject = subject_of(options, *content, request);
        const TemporaryFolder folder;
        core::ConvergeState state(folder.path());
        const StopFlag stop(options.stop);
        const StepCount steps(options.progress, core::converge_steps(settings, subject.methods.size()));
        const core::StepHook hook = steps.hook();
        core::ConvergeMeasurement measurement(settings, subject, state, hook);
        if (!measurement.run(stop.flag())) {
            throw Interrupted("converge: stopped before all runs were done");
        }
        const core::ConvergeSummary summary = *measurement.summary();
        const core::ReferencePicture& reference = *measurement.reference();
        const core::ReportHead head{request, settings, program_commit(), ""};
        ConvergeResult result;
        result.scene = content->name;
        result.width = request.settings.width;
        result.height = request.settings.height;
        for (const core::MethodSummary& method : summary.methods) {
            result.methods.push_back(result_of(method));
        }
        result.reference = reference.method;
        result.reference_spp = reference.spp;
        result.reference_relmse = summary.noise.relmse;
        result.target_relmse = summary.target_relmse;
        result.table = table_of(summary);
        result.text = core::summary_table(head, summary, reference);
        core::write_page_pictures(subject.methods, reference, page_side, state);
        result.page = core::page_html(core::summary_to_json(head, summary, reference, state), state);
        return result;
    });
}

DIPTYCH_END
