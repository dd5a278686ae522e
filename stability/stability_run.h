// The engine of `diptych stability`: cases on backends that are handed in.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "stability_cases.h"

namespace diptych::core::stability {

struct MeasuredCase {
    const Case* which;
    std::vector<CaseResult> results;  // one a backend
};

struct MeasuredBackend {
    std::string name;
    std::string device;
};

struct Report {
    Effort effort = Effort::full;
    std::vector<MeasuredBackend> backends;
    std::vector<MeasuredCase> cases;  // those of which every backend was measured
    bool interrupted = false;
};

bool passes(const Report& report);

/// Those of the rows named, all where none is. Throws Error with the rows that there are.
std::vector<const Case*> cases_of(const std::vector<std::string>& rows);

/// Calls `begin` before each case on each backend, from this thread. `cancel` is looked at between them.
Report run_cases(const std::vector<const Case*>& cases, const std::vector<std::unique_ptr<Backend>>& backends,
                 Effort effort, const std::atomic<bool>& cancel,
                 const std::function<void(const std::string& what)>& begin);

}  // namespace diptych::core::stability
