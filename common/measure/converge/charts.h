// The charts of `converge`: errors over time and over samples.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "chart/chart.h"
#include "measure/converge/state.h"

namespace diptych::core {

struct ErrorChart {
    std::string what;  // the button that chooses it: "relMSE"
    std::string over;  // likewise: "Time"
    chart::Chart chart;
    std::string note;  // what the reader has to know of it
};

/// One for each pair of what is drawn and over what, from summary.json. The first is the one to begin with.
std::vector<ErrorChart> error_charts(const nlohmann::ordered_json& summary);

/// error-time.svg and error-samples.svg in the folder. Throws Error.
void write_charts(const nlohmann::ordered_json& summary, const ConvergeState& state);

}  // namespace diptych::core
