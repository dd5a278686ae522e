#include "commands/stability/report.h"

#include <fmt/format.h>

#include <algorithm>

#include "image/atomic_file.h"
#include "console/output.h"
#include "console/report.h"

namespace diptych::core::app {

namespace {

using stability::Case;
using stability::CaseResult;

std::string range_text(const Case& c, stability::Effort effort) {
    if (c.range.parameter[0] == '\0') {
        return "";
    }
    const std::vector<double> points = stability::points_of(c.range, effort);
    return fmt::format("{} {:.4g} to {:.4g}", c.range.parameter, points.front(), points.back());
}

std::string where_text(const Case& c, const CaseResult& r) {
    if (r.worst == 0 && r.nonfinite == 0) {
        return "";
    }
    const std::string at =
        c.range.parameter[0] == '\0' ? "" : fmt::format("{} {:.4g}", c.range.parameter, r.worst_parameter);
    return at + (at.empty() || r.where.empty() ? "" : "; ") + r.where;
}

bool passes(const stability::MeasuredCase& m) {
    return std::all_of(m.results.begin(), m.results.end(), [](const CaseResult& r) { return r.passes; });
}

/// Letters and digits, everything else as single dashes.
std::string file_name(const std::string& text) {
    std::string name;
    for (const char c : text) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (plain) {
            name += c;
        } else if (!name.empty() && name.back() != '-') {
            name += '-';
        }
    }
    return name;
}

/// A field of comma-separated values (RFC 4180).
std::string quoted(const std::string& text) {
    std::string field = "\"";
    for (const char c : text) {
        field += c == '"' ? std::string("\"\"") : std::string(1, c);
    }
    return field + '"';
}

std::string to_csv(const stability::Report& report) {
    std::string csv = "row,case,backend,parameter,value,error,bound,nonfinite,evaluations,where\n";
    for (const stability::MeasuredCase& m : report.cases) {
        for (std::size_t b = 0; b < m.results.size(); ++b) {
            for (const stability::PointResult& p : m.results[b].points) {
                csv += fmt::format("{},{},{},{},{:.9g},{:.9g},{:.9g},{},{},{}\n", quoted(m.which->row),
                                   quoted(m.which->name), report.backends[b].name, quoted(m.which->range.parameter),
                                   p.parameter, p.measured.error, m.which->bound, p.measured.nonfinite,
                                   p.measured.evaluations, quoted(p.measured.where));
            }
        }
    }
    return csv;
}

}  // namespace

void print_case_list(const std::vector<const Case*>& cases, bool json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Case* c : cases) {
        const std::string range = range_text(*c, stability::Effort::full);
        if (json) {
            list.push_back({{"row", c->row}, {"case", c->name}, {"range", range}, {"bound", c->bound}});
        } else {
            print_result("{:<20} {}{}\n", c->row, c->name, range.empty() ? "" : " (" + range + ")");
        }
    }
    if (json) {
        print_json(list);
    }
}

void print_report(const stability::Report& report) {
    for (const stability::MeasuredBackend& backend : report.backends) {
        print_result("{}: {}\n", backend.name, backend.device);
    }
    print_result("\n| row | case | range | error |");
    for (const stability::MeasuredBackend& backend : report.backends) {
        print_result(" {} | not finite |", backend.name);
    }
    print_result(" bound | verdict | where |\n|---|---|---|---|");
    for (std::size_t b = 0; b < report.backends.size(); ++b) {
        print_result("---|---|");
    }
    print_result("---|---|---|\n");
    std::size_t failed = 0;
    for (const stability::MeasuredCase& m : report.cases) {
        const Case& c = *m.which;
        print_result("| {} | {} | {} | {} |", c.row, c.name, range_text(c, report.effort), c.measure);
        const CaseResult* worst = &m.results.front();
        for (const CaseResult& r : m.results) {
            print_result(" {:.2g} | {} |", r.worst, r.nonfinite);
            worst = r.worst > worst->worst ? &r : worst;
        }
        print_result(" {:g} | {} | {} |\n", c.bound, passes(m) ? "holds" : "FAILS", where_text(c, *worst));
        failed += passes(m) ? 0 : 1;
    }
    print_result("\n{} of {} cases hold their bounds\n", report.cases.size() - failed, report.cases.size());
}

nlohmann::ordered_json to_json(const stability::Report& report) {
    nlohmann::ordered_json json;
    json["program"] = program_version();
    json["effort"] = report.effort == stability::Effort::quick ? "quick" : "full";
    for (const stability::MeasuredBackend& backend : report.backends) {
        json["backends"].push_back({{"name", backend.name}, {"device", backend.device}});
    }
    json["passes"] = passes(report);
    json["cases"] = nlohmann::ordered_json::array();
    for (const stability::MeasuredCase& m : report.cases) {
        nlohmann::ordered_json entry = {{"row", m.which->row},         {"case", m.which->name},
                                        {"measure", m.which->measure}, {"parameter", m.which->range.parameter},
                                        {"bound", m.which->bound},     {"passes", passes(m)}};
        for (std::size_t b = 0; b < m.results.size(); ++b) {
            const CaseResult& r = m.results[b];
            nlohmann::ordered_json points = nlohmann::ordered_json::array();
            for (const stability::PointResult& p : r.points) {
                points.push_back(
                    {{"at", p.parameter}, {"error", p.measured.error}, {"nonfinite", p.measured.nonfinite}});
            }
            entry["backends"].push_back({{"name", report.backends[b].name},
                                         {"worst", r.worst},
                                         {"at", r.worst_parameter},
                                         {"where", r.where},
                                         {"nonfinite", r.nonfinite},
                                         {"evaluations", r.evaluations},
                                         {"seconds", r.seconds},
                                         {"passes", r.passes},
                                         {"points", points}});
        }
        json["cases"].push_back(entry);
    }
    return json;
}

std::vector<std::string> write_report(const stability::Report& report, const std::string& folder) {
    std::vector<std::string> files;
    const auto write = [&](const std::string& name, const std::string& text) {
        files.push_back(folder + "/" + name);
        write_file_atomically(files.back(), text);
    };
    write("table.json", to_json(report).dump(1) + "\n");
    write("table.csv", to_csv(report));
    std::size_t number = 0;
    for (const stability::MeasuredCase& m : report.cases) {
        ++number;
        if (m.results.front().points.size() > 1) {
            write(fmt::format("{:02}-{}.svg", number, file_name(fmt::format("{} {}", m.which->row, m.which->name))),
                  plot_case(report, m));
        }
    }
    return files;
}

}  // namespace diptych::core::app
