#include "extremes.h"

#include <set>

#include "skipping.h"
#if DIPTYCH_VULKAN
#include "vulkan_device.h"
#endif

namespace diptych::core::tests {

namespace {

void check_cases(stability::Backend& backend, const std::string& row, stability::Effort effort) {
    int cases = 0;
    for (const stability::Case& c : stability::all_cases()) {
        if (row != c.row) {
            continue;
        }
        ++cases;
        const stability::CaseResult r = stability::run_case(c, backend, effort);
        INFO(backend.name() << ": " << c.name << ": " << r.worst << " of " << c.bound << " allowed, " << r.nonfinite
                            << " not finite, of " << r.evaluations << "; at " << c.range.parameter << " "
                            << r.worst_parameter << " " << r.where);
        CHECK(r.worst <= c.bound);
        CHECK(r.nonfinite == 0);
        CHECK(r.evaluations > 0);
    }
    CHECK(cases > 0);
}

void check(const std::string& row, stability::Effort effort) {
    const auto cpu = stability::make_cpu_backend(0);
    check_cases(*cpu, row, effort);
#if DIPTYCH_VULKAN
    if (has_vulkan()) {
        {
            const auto vulkan = stability::make_vulkan_backend("", has_validation_layer());
            check_cases(*vulkan, row, effort);
        }
        check_no_validation_messages();
        return;
    }
#endif
    report_left_out("Vulkan: no device with ray tracing, or built without");
}

}  // namespace

void check_row(const std::string& row) {
    check(row, stability::Effort::quick);
}

void check_row_in_full(const std::string& row) {
    check(row, stability::Effort::full);
}

}  // namespace diptych::core::tests

TEST_CASE("The cases name the rows of the table of extremes") {
    std::set<std::string> rows;
    for (const diptych::core::stability::Case& c : diptych::core::stability::all_cases()) {
        rows.insert(c.row);
    }
    CHECK(rows.size() == 18);
}
