// The table of numerical stability, as text, CSV, JSON and plots.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "stability_cases.h"

namespace diptych::core::app {

struct MeasuredCase {
    const stability::Case* which;
    std::vector<stability::CaseResult> results;  // one a backend
};

struct MeasuredBackend {
    std::string name;
    std::string device;
};

struct StabilityReport {
    stability::Effort effort = stability::Effort::full;
    std::vector<MeasuredBackend> backends;
    std::vector<MeasuredCase> cases;
};

bool passes(const StabilityReport& report);

void print_case_list(const std::vector<const stability::Case*>& cases, bool json);

/// As a table that Markdown shows too.
void print_report(const StabilityReport& report);

nlohmann::ordered_json to_json(const StabilityReport& report);

/// table.json, table.csv (every point), and NN-case.svg; returns what was written.
std::vector<std::string> write_report(const StabilityReport& report, const std::string& folder);

/// Error over the parameter, one curve a backend, the bound as a line.
std::string plot_case(const StabilityReport& report, const MeasuredCase& measured);

}  // namespace diptych::core::app
