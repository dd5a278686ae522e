#include "measure/converge/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "settings/names.h"
#include "stats/multiple_testing.h"

namespace diptych::core {

namespace {

// Frames of a chain depend on one another for about twice the confidence cap; only then does the error fall as 1/N.
constexpr std::uint32_t settled_frames = 64;
constexpr double least_errors_above_noise = 4;
constexpr double heavy_share = 0.05;
constexpr int independent_block = 1;  // pixels have random numbers of their own
constexpr int reuse_block = 32;       // reuse connects neighbours

std::vector<double> column(const std::vector<const ErrorRow*>& rows, double ErrorRow::*field) {
    std::vector<double> values;
    for (const ErrorRow* row : rows) {
        values.push_back(row->*field);
    }
    return values;
}

CheckpointSummary summarize_checkpoint(std::uint32_t spp, const std::vector<const ErrorRow*>& rows,
                                       const ReferenceNoise& noise) {
    CheckpointSummary point;
    point.spp = spp;
    point.device_seconds = median(column(rows, &ErrorRow::device_seconds));
    point.wall_seconds = median(column(rows, &ErrorRow::wall_seconds));
    point.mse = mean_interval(column(rows, &ErrorRow::mse));
    point.relmse = mean_interval(column(rows, &ErrorRow::relmse));
    point.relmse_trimmed = mean_interval(column(rows, &ErrorRow::relmse_trimmed));
    point.trimmed_energy = mean_interval(column(rows, &ErrorRow::trimmed_energy)).value;
    point.mse_net = point.mse.value - noise.mse;
    point.relmse_net = point.relmse.value - noise.relmse;
    point.efficiency = 1 / (point.mse_net * point.device_seconds);
    for (const ErrorRow* row : rows) {
        point.nonfinite += row->nonfinite;
    }
    return point;
}

/// Of the kept counts, the errors of every run less what the reference adds on average.
ErrorTable table_of(const std::vector<std::vector<const ErrorRow*>>& by_count, const std::vector<std::size_t>& kept,
                    double ErrorRow::*field, double less) {
    ErrorTable table(by_count.front().size());
    for (const std::size_t i : kept) {
        for (std::size_t run = 0; run < table.size(); ++run) {
            table[run].push_back(by_count[i][run]->*field - less);
        }
    }
    return table;
}

void fit(MethodSummary& method, const std::vector<std::vector<const ErrorRow*>>& by_count,
         const ReferenceNoise& noise) {
    std::vector<std::size_t> kept;
    std::vector<double> samples;
    std::vector<bool> above_noise, relmse_above_noise;
    for (std::size_t i = 0; i < method.checkpoints.size(); ++i) {
        const CheckpointSummary& point = method.checkpoints[i];
        if (!method.method->chained() || point.spp >= settled_frames) {
            kept.push_back(i);
            samples.push_back(point.spp);
            above_noise.push_back(point.mse_net > least_errors_above_noise * noise.mse_error);
            relmse_above_noise.push_back(point.relmse_net > least_errors_above_noise * noise.relmse_error);
        }
    }
    const ErrorTable mse = table_of(by_count, kept, &ErrorRow::mse, noise.mse);
    method.slope_mse = log_slope(samples, mse, above_noise);
    const ErrorTable relmse = table_of(by_count, kept, &ErrorRow::relmse, noise.relmse);
    method.slope_relmse = log_slope(samples, relmse, relmse_above_noise);
    method.fit = fit_bias(samples, mse, noise.mse_error);
    method.fit_relmse = fit_bias(samples, relmse, noise.relmse_error);
}

MethodSummary summarize_method(const Method& method, const ReferencePicture& reference, const ReferenceNoise& noise,
                               const ConvergeState& state) {
    MethodSummary summary;
    summary.method = &method;
    summary.runs = state.runs(method.name);
    summary.setup = state.setup(method.name);
    summary.picture = state.picture(method.name);
    std::map<std::uint32_t, std::vector<const ErrorRow*>> counts;
    for (const ErrorRow& row : state.rows()) {
        if (row.method == method.name) {
            counts[row.spp].push_back(&row);
        }
    }
    const std::map<std::uint32_t, DeviationSums> sums = state.load_sums(method.name);
    std::vector<std::vector<const ErrorRow*>> by_count;
    for (const auto& [spp, rows] : counts) {
        by_count.push_back(rows);
        summary.checkpoints.push_back(summarize_checkpoint(spp, rows, noise));
        if (const auto found = sums.find(spp); found != sums.end()) {
            const int width = reference.image.color.width, block = method.chained() ? reuse_block : independent_block;
            CheckpointSummary& point = summary.checkpoints.back();
            point.bias = bias_squared(found->second, reference.variance, {}, width, 3, block);
            point.relative_bias = bias_squared(found->second, reference.variance, reference.weights, width, 3, block);
        }
    }
    fit(summary, by_count, noise);
    return summary;
}

std::vector<double> holm_of_known(const std::vector<double>& p) {
    std::vector<double> known;
    std::copy_if(p.begin(), p.end(), std::back_inserter(known), [](double value) { return !std::isnan(value); });
    const std::vector<double> adjusted = holm_adjusted(known);
    std::vector<double> all;
    std::size_t next = 0;
    for (const double value : p) {
        all.push_back(std::isnan(value) ? value : adjusted[next++]);
    }
    return all;
}

bool biased_by_choice(const Method& method) {
    const RenderSettings& settings = method.request.settings;
    return method.request.backend != "oracle" && resamples(settings.integrator) &&
           (settings.resampling.mis == ResamplingMis::biased_one_over_m ||
            settings.resampling.visibility == ResamplingVisibility::biased_initial ||
            settings.resampling.visibility == ResamplingVisibility::biased_final);
}

std::string bias_text(const MethodSummary& summary, const ReferencePicture& reference) {
    const BiasSquared& bias = summary.checkpoints.back().relative_bias;
    if (std::isnan(summary.bias_p)) {
        return "not tested: too few runs or pixels";
    }
    if (!(summary.bias_p < bias_alpha)) {
        return fmt::format("none seen; below {:.2g} % of a pixel",
                           100 * std::sqrt(std::max(bias.value, 0.0) + 1.645 * bias.standard_error));
    }
    const std::string size = fmt::format("{:.2g} % of a pixel", 100 * std::sqrt(std::max(0.0, bias.value)));
    if (biased_by_choice(*summary.method)) {
        return size + ": biased by choice";
    }
    if (!reference.variance_known) {
        return size + ": the reference's own noise, which is not known, is part of it";
    }
    if (bias.heavy > heavy_share) {
        return size +
               fmt::format(
                   ": tails; of {:.0f} % of the values one run holds most of the noise, so what is rare looks lost",
                   100 * bias.heavy);
    }
    return size + ": not explained here; see diptych verify";
}

}  // namespace

ConvergeSummary summarize_results(const ConvergeSettings& settings, const std::vector<Method>& methods,
                                  const ReferencePicture& reference, const ConvergeState& state) {
    ConvergeSummary summary;
    summary.noise = noise_of(reference);
    std::vector<double> fit_p, bias_p, last_errors, last_times;
    for (const Method& method : methods) {
        if (state.runs(method.name) == 0) {
            continue;
        }
        summary.methods.push_back(summarize_method(method, reference, summary.noise, state));
        const MethodSummary& added = summary.methods.back();
        fit_p.push_back(method.chained() ? std::nan("") : added.fit_relmse.p);  // its model is of independent samples
        bias_p.push_back(added.checkpoints.back().relative_bias.p);
        last_errors.push_back(added.checkpoints.back().relmse_net);
        last_times.push_back(added.checkpoints.back().device_seconds);
    }
    fit_p = holm_of_known(fit_p);
    bias_p = holm_of_known(bias_p);
    summary.target_relmse = settings.target_relmse > 0 ? settings.target_relmse : median(last_errors);
    if (!last_times.empty()) {
        summary.equal_seconds = settings.picture_seconds > 0 ? settings.picture_seconds
                                                             : *std::min_element(last_times.begin(), last_times.end());
    }
    for (std::size_t i = 0; i < summary.methods.size(); ++i) {
        MethodSummary& method = summary.methods[i];
        method.fit_p = fit_p[i];
        method.bias_p = bias_p[i];
        method.bias_text = bias_text(method, reference);
        std::vector<double> seconds, errors;
        for (const CheckpointSummary& point : method.checkpoints) {
            seconds.push_back(point.device_seconds);
            errors.push_back(point.relmse_net);
        }
        method.to_target = time_to_target(seconds, errors, summary.target_relmse);
    }
    return summary;
}

}  // namespace diptych::core
