#include "stability_cases.h"

#include <cmath>

#include "case_parts.h"
#include "clock.h"

namespace diptych::core::stability {

const std::vector<Case>& all_cases() {
    static const std::vector<Case> cases = [] {
        std::vector<Case> all;
        add_ray_cases(all);
        add_geometry_cases(all);
        add_flattened_cases(all);
        add_microfacet_cases(all);
        add_surface_cases(all);
        add_sum_cases(all);
        add_light_scene_cases(all);
        add_film_scene_cases(all);
        return all;
    }();
    return cases;
}

std::vector<double> points_of(const Range& range, Effort effort) {
    const int count = effort == Effort::quick ? range.quick_points : range.full_points;
    const double last = effort == Effort::quick && range.quick_last != 0 ? range.quick_last : range.last;
    std::vector<double> points;
    for (int i = 0; i < count; ++i) {
        const double t = count > 1 ? static_cast<double>(i) / (count - 1) : 0;
        const double ratio = range.logarithmic ? last / range.first : 1;
        points.push_back(i > 0 && i == count - 1 ? last
                         : range.logarithmic     ? range.first * std::pow(ratio, t)
                                                 : range.first + (last - range.first) * t);
    }
    return points;
}

CaseResult run_case(const Case& c, Backend& backend, Effort effort) {
    const Stopwatch watch;
    CaseResult result;
    for (const double parameter : points_of(c.range, effort)) {
        const Measured m = c.run(backend, parameter, effort);
        if (m.error > result.worst || (m.nonfinite > 0 && result.nonfinite == 0) || result.points.empty()) {
            result.worst = std::max(result.worst, m.error);
            result.worst_parameter = parameter;
            result.where = m.where;
        }
        result.nonfinite += m.nonfinite;
        result.evaluations += m.evaluations;
        result.points.push_back({parameter, m});
    }
    result.passes = result.worst <= c.bound && result.nonfinite == 0 && result.evaluations > 0;
    result.seconds = watch.seconds();
    return result;
}

}  // namespace diptych::core::stability
