// How does the error of several methods fall over samples and over time?
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "diptych/film.h"
#include "diptych/scene.h"
#include "diptych/settings.h"

DIPTYCH_BEGIN

struct ConvergeOptions {
    /// "BACKEND:INTEGRATOR", "BACKEND:INTEGRATOR:SAMPLER", "oracle" or "oracle:MODE".
    std::vector<std::string> methods{"cpu:brdf", "cpu:direct", "cpu:path"};
    std::uint32_t runs = 16;      // of each method, each with a seed of its own; at least 2
    std::uint32_t spp_max = 256;  // samples a pixel of a run: the power of two that is not above it
    double seconds = 0;           // above 0, instead: the power of two that a method renders in so long
    /// What errors are measured against: a method, "auto", or a picture's file. A method renders 16 times the samples
    /// of a run. "auto" is `path`, on a backend for which it is not measured, or with the other MIS weights.
    std::string reference = "auto";
    std::optional<Film> reference_film;  // instead
    double target_relmse = 0;            // that times are told to; 0 is what half of the methods reach
    double picture_seconds = 0;          // of rendering that the page's pictures show; 0 is the shortest of the runs
    Settings settings;                   // but for the integrator; all seeds derive from the seed
    std::string device;                  // vulkan
    int threads = 0;                     // cpu, oracle
    std::stop_token stop;
    /// Called before each step, with what it is to do ("cpu:path, run 2 of 16") and how many of the steps are done.
    std::function<void(const std::string& step, int done, int steps)> progress;
};

/// A value with its 95 % confidence interval. NaN is unknown.
struct Estimate {
    double value = 0;
    double low = 0;
    double high = 0;
};

/// An estimate of the squared bias whose expectation is that bias. Without bias it scatters about 0, and is often
/// negative.
struct BiasEstimate {
    double value = 0;
    double standard_error = 0;
    double p = 1;      // one-sided, that there is no bias
    double heavy = 0;  // share of the values of which one run alone holds most of the noise
};

/// A method after so many samples a pixel, over its runs. docs/converge.md defines each.
struct ConvergePoint {
    std::uint32_t spp = 0;
    double device_seconds = 0;  // medians
    double wall_seconds = 0;
    Estimate mse;  // the reference's own noise is part of these three
    Estimate relmse;
    Estimate relmse_trimmed;    // without the worst 0.1 % of the pixels
    double trimmed_energy = 0;  // share of the picture's energy that those pixels hold
    double mse_net = 0;         // without the reference's noise
    double relmse_net = 0;
    double efficiency = 0;       // 1 / (mse_net device_seconds)
    BiasEstimate bias_squared;   // of all values alike
    BiasEstimate relative_bias;  // weighted as relMSE is: what the verdict goes by
    std::uint64_t nonfinite = 0;
};

/// When a method reaches the target.
enum class TargetTime { reached, earlier, later, unknown };

struct ConvergeMethod {
    std::string method;
    std::string device;
    std::uint32_t runs = 0;
    std::vector<ConvergePoint> points;  // at 1, 2, 4, 8... samples
    Estimate slope_mse;                 // of log MSE over log samples: -1 for independent samples
    Estimate slope_relmse;
    double bias_p = 1;          // of the last point's relative bias, corrected for the number of methods
    bool bias_significant = false;
    std::string bias_text;      // what to make of it
    TargetTime target = TargetTime::unknown;
    double target_seconds = 0;  // until the target, or the first or last measured time
};

/// A figure of every method and sample count.
struct ConvergeColumn {
    std::string name;
    std::vector<double> values;  // NaN where it is not known
};

struct ConvergeTable {
    std::vector<std::string> method;  // of each row
    std::vector<ConvergeColumn> columns;
};

struct ConvergeResult {
    std::string scene;
    int width = 0;
    int height = 0;
    std::vector<ConvergeMethod> methods;
    std::string reference;            // what it is
    std::uint32_t reference_spp = 0;  // 0 is unknown
    double reference_relmse = 0;      // of the reference itself, where that is known
    double target_relmse = 0;
    ConvergeTable table;  // the columns of summary.csv (docs/converge.md)
    std::string text;     // a line a method, as the program's `converge` prints them
    std::string page;     // HTML with charts and pictures, within one file
};

/// Renders every method's runs and measures their errors. Throws Interrupted where it was stopped, SettingError,
/// NoDevice and Error.
DIPTYCH_EXPORT ConvergeResult converge(const Scene& scene, const ConvergeOptions& options = {});

DIPTYCH_END
