#include "stability_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "error.h"

namespace diptych::core::stability {

bool passes(const Report& report) {
    return std::all_of(report.cases.begin(), report.cases.end(), [](const MeasuredCase& m) {
        return std::all_of(m.results.begin(), m.results.end(), [](const CaseResult& r) { return r.passes; });
    });
}

std::vector<const Case*> cases_of(const std::vector<std::string>& rows) {
    std::vector<const Case*> chosen;
    std::string names;
    for (const Case& c : all_cases()) {
        if (rows.empty() || std::count(rows.begin(), rows.end(), c.row) > 0) {
            chosen.push_back(&c);
        }
        if (names.find(c.row) == std::string::npos) {
            names += (names.empty() ? "" : ", ") + std::string(c.row);
        }
    }
    for (const std::string& row : rows) {
        if (std::none_of(chosen.begin(), chosen.end(), [&](const Case* c) { return row == c->row; })) {
            throw Error(fmt::format("row {}: there is no such row; there are {}", row, names));
        }
    }
    return chosen;
}

Report run_cases(const std::vector<const Case*>& cases, const std::vector<std::unique_ptr<Backend>>& backends,
                 Effort effort, const std::atomic<bool>& cancel,
                 const std::function<void(const std::string& what)>& begin) {
    Report report;
    report.effort = effort;
    for (const auto& backend : backends) {
        report.backends.push_back({backend->name(), backend->device()});
    }
    for (const Case* c : cases) {
        MeasuredCase measured{c, {}};
        for (const auto& backend : backends) {
            if (cancel) {
                report.interrupted = true;
                return report;
            }
            begin(fmt::format("{}: {}: {}", backend->name(), c->row, c->name));
            measured.results.push_back(run_case(*c, *backend, effort));
        }
        report.cases.push_back(std::move(measured));
    }
    return report;
}

}  // namespace diptych::core::stability
