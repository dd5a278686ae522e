// The table of numerical stability, as text, CSV, JSON and plots.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "stability_run.h"

namespace diptych::core::app {

void print_case_list(const std::vector<const stability::Case*>& cases, bool json);

/// As a table that Markdown shows too.
void print_report(const stability::Report& report);

nlohmann::ordered_json to_json(const stability::Report& report);

/// table.json, table.csv (every point), and NN-case.svg; returns what was written.
std::vector<std::string> write_report(const stability::Report& report, const std::string& folder);

/// Error over the parameter, one curve a backend, the bound as a line.
std::string plot_case(const stability::Report& report, const stability::MeasuredCase& measured);

}  // namespace diptych::core::app
