// What a measurement of convergence found, as JSON, as columns and as text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "measure/converge/summary.h"

namespace diptych::core {

/// What was measured, and how.
struct ReportHead {
    const RenderRequest& request;
    const ConvergeSettings& settings;
    std::string commit;   // of the program
    std::string command;  // that measured it; empty where there is none
};

/// Everything, as docs/converge.md describes it.
nlohmann::ordered_json summary_to_json(const ReportHead& head, const ConvergeSummary& summary,
                                       const ReferencePicture& reference, const ConvergeState& state);

/// A figure of a method after so many samples; NaN where it is not known.
struct SummaryColumn {
    const char* name;
    double (*value)(const CheckpointSummary& point);
};
std::span<const SummaryColumn> summary_columns();

/// A line for each method and sample count: the method, its runs and the columns.
std::string summary_to_csv(const ConvergeSummary& summary);

/// A line for each method, and what its words mean; without the end of the last line.
std::string summary_table(const ReportHead& head, const ConvergeSummary& summary, const ReferencePicture& reference);

/// "reached", "earlier", "later" or "unknown".
const char* name_of(TargetTime::Kind kind);

}  // namespace diptych::core
