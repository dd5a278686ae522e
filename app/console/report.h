// What the program says: errors and warnings on stderr, results on stdout.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/warnings.h"

namespace diptych::core::app {

/// "diptych 0.1.0 (commit …)".
std::string program_version();

/// One line each on stderr, with options in the place of settings that a message of the library names.
void report_error(const std::string& message);
void report_warning(const std::string& message);

/// Each distinct warning once.
void report_warnings(const std::vector<std::string>& messages);
void report_warnings(const Warnings& warnings);

/// One line on stdout. Numbers that JSON cannot hold become null.
void print_json(const nlohmann::ordered_json& json);

/// 1234567 as "1.23 M", to be followed by a unit; bytes by binary thousands, with theirs.
std::string with_prefix(double value);
std::string byte_text(double bytes);

}  // namespace diptych::core::app
