#include "console/report.h"

#include <fmt/format.h>

#include <cstdio>
#include <set>

#include "build_info.h"
#include "console/option_names.h"
#include "console/output.h"
#include "one_line.h"

namespace diptych::core::app {

namespace {

void print_error_line(const std::string& line) {
    print_message("diptych: {}\n", one_line(with_option_names(line)));
}

std::string scaled(double value, double thousand, const std::vector<const char*>& units) {
    std::size_t unit = 0;
    while (value >= thousand && unit + 1 < units.size()) {
        value /= thousand;
        ++unit;
    }
    return fmt::format("{:.{}f} {}", value, unit == 0 ? 0 : value < 10 ? 2 : 1, units[unit]);
}

}  // namespace

std::string program_version() {
    return build_info::program();
}

void report_error(const std::string& message) {
    print_error_line(message);
}
void report_warning(const std::string& message) {
    print_error_line("warning: " + message);
}

void report_warnings(const std::vector<std::string>& messages) {
    std::set<std::string> seen;
    for (const std::string& message : messages) {
        if (seen.insert(message).second) {
            report_warning(message);
        }
    }
}

void report_warnings(const Warnings& warnings) {
    report_warnings(warnings.lines());
}

void print_json(const nlohmann::ordered_json& json) {
    write_data(json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

std::string with_prefix(double value) {
    return scaled(value, 1000, {"", "k", "M", "G", "T"});
}

std::string byte_text(double bytes) {
    return scaled(bytes, 1024, {"B", "KiB", "MiB", "GiB", "TiB"});
}

}  // namespace diptych::core::app
