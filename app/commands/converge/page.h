// The page and the plots of `converge`.
#pragma once

#include <nlohmann/json.hpp>

#include "measure/converge/state.h"

namespace diptych::core::app {

/// index.html in the folder: summary and pictures within one file that needs no other. Throws Error.
void write_page(const nlohmann::ordered_json& summary, const ConvergeState& state);

/// error-time.svg, error-samples.svg and the same as .png, by gnuplot from the summary, and plots.gp that made them.
/// False, with a warning, where there is no gnuplot or it fails. Throws Error.
bool write_plots(const nlohmann::ordered_json& summary, const ConvergeState& state);

}  // namespace diptych::core::app
