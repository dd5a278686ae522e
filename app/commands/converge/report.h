// What `converge` found, as JSON, as CSV and as text.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "commands/converge/plan.h"
#include "measure/converge/summary.h"

namespace diptych::core::app {

/// Everything, as docs/converge.md describes it.
nlohmann::ordered_json summary_to_json(const ConvergeOptions& options, const ConvergeSummary& summary,
                                       const ReferencePicture& reference, const ConvergeState& state);

/// A line for each method and sample count.
std::string summary_to_csv(const ConvergeSummary& summary);

void print_summary(const ConvergeOptions& options, const ConvergeSummary& summary, const ReferencePicture& reference);

}  // namespace diptych::core::app
