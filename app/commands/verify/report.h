// What `verify` found, as a table, as JSON and as pictures.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "commands/verify/options.h"
#include "measure/verify_suite.h"

namespace diptych::core::app {

/// FAIL where one pair fails, else INCONCLUSIVE where one is.
Verdict verdict_of(const SuiteResult& suite);

/// The command that would tell where a pair is inconclusive, its samples estimated from the noise; empty where none is.
/// With seeds of its own where a difference that was seen is the reason to go on.
std::string next_command(const VerifyOptions& options, const SuiteResult& suite);

void print_suite(const VerifyOptions& options, const SuiteResult& suite);
nlohmann::ordered_json suite_to_json(const VerifyOptions& options, const SuiteResult& suite);

/// Writes NAME-p.svg (a map of the tiles' p-values) and NAME-histogram.svg for every pair into the folder, NAME as
/// "vulkan-path-vs-cpu-path" or "vulkan-path-vs-cpu-path-frame-4"; returns their paths. Throws Error.
std::vector<std::string> write_suite_figures(const std::string& folder, const SuiteResult& suite);

/// Makes the folder where it is missing, and refuses one that cannot be written to.
void prepare_folder(const std::string& folder);

}  // namespace diptych::core::app
