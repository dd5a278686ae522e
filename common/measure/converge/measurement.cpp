#include "measure/converge/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "measure/converge/picture.h"
#include "measure/converge/reference_blocks.h"

namespace diptych::core {

int converge_steps(const ConvergeSettings& settings, std::size_t methods) {
    return static_cast<int>(reference_blocks + methods * (settings.runs + 2));
}

ConvergeMeasurement::ConvergeMeasurement(const ConvergeSettings& settings, const ConvergeSubject& subject,
                                         ConvergeState& state, const StepHook& begin)
    : settings_(settings), subject_(subject), state_(state), begin_(begin), noted_(subject.methods.size()) {
    for (const Method& method : subject.methods) {
        runners_.push_back(std::make_unique<MethodRunner>(subject.scene, method, subject.open, subject.device_loss));
    }
}

bool ConvergeMeasurement::run(const std::atomic<bool>& cancel) {
    return find_limits(cancel) && find_reference(cancel) && render_runs(cancel) && render_pictures(cancel);
}

std::optional<ConvergeSummary> ConvergeMeasurement::summary() const {
    if (!reference_ || state_.rows().empty()) {
        return std::nullopt;
    }
    return summarize_results(settings_, subject_.methods, *reference_, state_);
}

std::vector<std::uint32_t> ConvergeMeasurement::counts_of(std::size_t method) const {
    std::vector<std::uint32_t> counts;
    for (std::uint32_t spp = 1; spp <= limits_[method]; spp *= 2) {
        counts.push_back(spp);
    }
    return counts;
}

bool ConvergeMeasurement::find_limits(const std::atomic<bool>& cancel) {
    for (const std::unique_ptr<MethodRunner>& runner : runners_) {
        const std::string& name = runner->method().name;
        std::uint32_t limit = std::bit_floor(settings_.spp_max);
        if (const std::optional<std::uint32_t> known = state_.limit(name)) {
            limit = *known;
        } else if (settings_.seconds > 0) {
            begin_(name + ", how many samples fit the time");
            limit = runner->samples_within(settings_.seconds, cancel);
            if (limit == 0) {
                return false;
            }
            state_.set_limit(name, limit);
        }
        limits_.push_back(limit);
    }
    return true;
}

bool ConvergeMeasurement::find_reference(const std::atomic<bool>& cancel) {
    if (subject_.given_reference) {
        reference_ = subject_.given_reference;
        return true;
    }
    MethodRunner runner(subject_.scene, *subject_.reference, subject_.open, subject_.device_loss);
    const std::uint32_t spp = *std::max_element(limits_.begin(), limits_.end());
    reference_ = render_reference(runner, spp, settings_.maker, state_, cancel, [&](std::uint32_t block) {
        begin_(fmt::format("reference by {}, block {} of {}", runner.method().name, block + 1, reference_blocks));
    });
    return reference_.has_value();
}

bool ConvergeMeasurement::render_runs(const std::atomic<bool>& cancel) {
    for (const Method& method : subject_.methods) {
        sums_.push_back(state_.load_sums(method.name));
    }
    for (std::uint32_t run = 0; run < settings_.runs; ++run) {
        for (std::size_t i = 0; i < runners_.size(); ++i) {
            if (!render_run(i, run, cancel)) {
                return false;
            }
        }
    }
    return true;
}

/// Lines and sums are two files, and an end between them leaves one a run behind: that one alone is then caught up.
bool ConvergeMeasurement::render_run(std::size_t index, std::uint32_t run, const std::atomic<bool>& cancel) {
    MethodRunner& runner = *runners_[index];
    const Method& method = runner.method();
    std::map<std::uint32_t, DeviationSums>& sums = sums_[index];
    const bool lacks_rows = run >= state_.runs(method.name);
    const bool lacks_sums = sums.empty() || run >= sums.begin()->second.runs;
    if (!lacks_rows && !lacks_sums) {
        return true;
    }
    begin_(fmt::format("{}, run {} of {}", method.name, run + 1, settings_.runs));
    note_setup(index);
    const std::uint32_t seed = method.seed_of(run);
    std::vector<ErrorRow> rows;
    std::map<std::uint32_t, std::vector<float>> deviations;
    const bool whole = runner.run(
        seed, counts_of(index), cancel,
        [&](std::uint32_t spp, const Film& film, double device_seconds, double wall_seconds) {
            ErrorRow row = errors_of(film, *reference_);
            row.method = method.name;
            row.run = run;
            row.seed = seed;
            row.spp = spp;
            row.device_seconds = device_seconds;
            row.wall_seconds = wall_seconds;
            rows.push_back(row);
            deviations[spp] = deviations_of(film, *reference_);
        });
    if (!whole) {
        return false;
    }
    if (lacks_sums) {
        for (const auto& [spp, values] : deviations) {
            sums[spp].add(values);
        }
        state_.save_sums(method.name, sums);
    }
    if (lacks_rows) {
        state_.append(rows);
    }
    return true;
}

bool ConvergeMeasurement::render_pictures(const std::atomic<bool>& cancel) {
    const double seconds = summary()->equal_seconds;
    for (const std::unique_ptr<MethodRunner>& runner : runners_) {
        begin_(fmt::format("{}, its picture", runner->method().name));
        if (!render_picture(*runner, seconds, *reference_, settings_.maker, state_, cancel)) {
            return false;
        }
    }
    return true;
}

void ConvergeMeasurement::note_setup(std::size_t index) {
    if (!noted_[index]) {
        state_.set_setup(subject_.methods[index].name, runners_[index]->setup());
        noted_[index] = true;
    }
}

}  // namespace diptych::core
