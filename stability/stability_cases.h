// The cases of numerical stability: for each row of the table of extremes what is measured, over which range, and how
// far it may be off. `diptych stability` prints them and tests/extremes holds them, so that table and tests are one.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "stability_backend.h"

namespace diptych::core::stability {

/// How many points of a range and samples of a picture: seconds in all, or minutes.
enum class Effort { quick, full };

/// What one point of a case's range came to.
struct Measured {
    double error = 0;               // the worst
    std::uint64_t nonfinite = 0;    // results that should have been numbers, samples that a film dropped
    std::uint64_t evaluations = 0;  // results, or samples
    std::string where;              // beside the parameter, where the worst was
};

/// The parameter's points, spread evenly or by ratio.
struct Range {
    const char* parameter;  // "alpha"; empty: one point
    double first = 0;
    double last = 0;
    bool logarithmic = false;
    int quick_points = 1;
    int full_points = 1;
    double quick_last = 0;  // where a quick run ends; 0: at the same place
};

struct Case {
    const char* row;   // of the table of extremes
    const char* name;  // what is measured against what
    Range range;
    double bound;         // that the error may reach
    const char* measure;  // what kind of error: "relative", "absolute", "count", …
    std::function<Measured(Backend&, double parameter, Effort)> run;
};

struct PointResult {
    double parameter = 0;
    Measured measured;
};

struct CaseResult {
    std::vector<PointResult> points;
    double worst = 0;
    double worst_parameter = 0;
    std::string where;
    std::uint64_t nonfinite = 0;
    std::uint64_t evaluations = 0;
    double seconds = 0;
    bool passes = false;  // no error beyond the bound, nothing that is not finite
};

/// All of them, row by row.
const std::vector<Case>& all_cases();

std::vector<double> points_of(const Range& range, Effort effort);

CaseResult run_case(const Case& c, Backend& backend, Effort effort);

}  // namespace diptych::core::stability
