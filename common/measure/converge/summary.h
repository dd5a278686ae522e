// From the errors of all runs to what they say: bands, slopes, bias, times.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/converge/method.h"
#include "measure/converge/state.h"
#include "stats/convergence.h"

namespace diptych::core {

/// A method after so many samples, over its runs.
struct CheckpointSummary {
    std::uint32_t spp = 0;
    double device_seconds = 0;  // medians
    double wall_seconds = 0;
    Interval mse;  // of the reference too: its noise is part of these three
    Interval relmse;
    Interval relmse_trimmed;
    double trimmed_energy = 0;
    double mse_net = 0;  // without the reference's noise
    double relmse_net = 0;
    double efficiency = 0;      // 1 / (mse_net device_seconds)
    BiasSquared bias;           // of all values alike
    BiasSquared relative_bias;  // weighted by 1 / (r² + 1e-2), as relMSE is: what the verdict goes by
    std::uint64_t nonfinite = 0;
};

struct MethodSummary {
    const Method* method = nullptr;
    std::uint32_t runs = 0;
    std::vector<CheckpointSummary> checkpoints;
    Interval slope_mse;
    Interval slope_relmse;
    BiasFit fit;            // of the MSE without the reference's noise
    BiasFit fit_relmse;     // and of the relMSE
    double fit_p = 0;       // p of fit_relmse's bias², corrected for the number of methods (Holm)
    double bias_p = 0;      // p of the last checkpoint's relative bias², likewise
    std::string bias_text;  // what to make of it
    TargetTime to_target;
    std::optional<MethodSetup> setup;
    std::optional<MethodPicture> picture;
};

struct ConvergeSummary {
    std::vector<MethodSummary> methods;  // those with at least one run
    ReferenceNoise noise;
    double target_relmse = 0;
    double equal_seconds = 0;  // of the pictures
};

/// A bias is called significant below this, over all methods together.
inline constexpr double bias_alpha = 0.01;

/// The methods must live as long.
ConvergeSummary summarize_results(const ConvergeSettings& settings, const std::vector<Method>& methods,
                                  const ReferencePicture& reference, const ConvergeState& state);

}  // namespace diptych::core
