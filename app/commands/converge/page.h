// The page of `converge`.
#pragma once

#include <nlohmann/json.hpp>

#include "measure/converge/state.h"

namespace diptych::core::app {

/// index.html in the folder: summary and pictures within one file that needs no other. Throws Error.
void write_page(const nlohmann::ordered_json& summary, const ConvergeState& state);

}  // namespace diptych::core::app
