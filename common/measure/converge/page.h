// The page of `converge`.
#pragma once

#include <nlohmann/json.hpp>

#include "measure/converge/state.h"

namespace diptych::core {

/// Summary, and the pictures that lie in the folder, within one file that needs no other. Throws Error.
std::string page_html(const nlohmann::ordered_json& summary, const ConvergeState& state);

/// The same as index.html in the folder. Throws Error.
void write_page(const nlohmann::ordered_json& summary, const ConvergeState& state);

}  // namespace diptych::core
