// How the error of several methods falls over samples and over time, measured.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "measure/converge/runner.h"
#include "measure/converge/summary.h"
#include "measure/step_hook.h"

namespace diptych::core {

/// What is rendered, by what, and what it is measured against: a picture that is given, or what renders one.
struct ConvergeSubject {
    const Scene& scene;
    std::vector<Method> methods;
    std::optional<ReferencePicture> given_reference;
    std::optional<Method> reference;  // where none is given
    OpenSession open;
    DeviceLossPolicy device_loss = {};  // a run whose device is lost is rendered again
};

/// Times that the hook of a ConvergeMeasurement is called at most.
int converge_steps(const ConvergeSettings& settings, std::size_t methods);

/// Every method renders its runs, each with a seed of its own, and is measured at 1, 2, 4, 8... samples a pixel. What
/// is finished is kept in `state`, whose folder must belong to the same plan, and not measured again.
class ConvergeMeasurement {
public:
    /// All of these must live as long.
    ConvergeMeasurement(const ConvergeSettings& settings, const ConvergeSubject& subject, ConvergeState& state,
                        const StepHook& begin);

    /// False where `cancel` came before the end. What is finished is kept either way. Throws NoDevice, Error, and
    /// DeviceLost as the subject has it.
    bool run(const std::atomic<bool>& cancel);

    /// What the results so far say; nothing where there are none yet.
    std::optional<ConvergeSummary> summary() const;

    /// Nothing before it is finished.
    const std::optional<ReferencePicture>& reference() const { return reference_; }

private:
    std::vector<std::uint32_t> counts_of(std::size_t method) const;
    bool find_limits(const std::atomic<bool>& cancel);
    bool find_reference(const std::atomic<bool>& cancel);
    bool render_runs(const std::atomic<bool>& cancel);
    bool render_run(std::size_t index, std::uint32_t run, const std::atomic<bool>& cancel);
    bool render_pictures(const std::atomic<bool>& cancel);
    void note_setup(std::size_t index);

    const ConvergeSettings& settings_;
    const ConvergeSubject& subject_;
    ConvergeState& state_;
    const StepHook& begin_;
    std::vector<std::unique_ptr<MethodRunner>> runners_;  // of each method, as those below
    std::vector<bool> noted_;                             // its setup has been written down
    std::vector<std::uint32_t> limits_;                   // samples a pixel
    std::vector<std::map<std::uint32_t, DeviationSums>> sums_;
    std::optional<ReferencePicture> reference_;
};

}  // namespace diptych::core
