#include "stats/power.h"

#include <cmath>

#include "stats/distributions.h"

namespace diptych::core {

double samples_per_side(double alpha, double power, double cv, double delta) {
    const double z = normal_quantile(1 - alpha / 2) + normal_quantile(power);
    return 2 * z * z * (cv / delta) * (cv / delta);
}

double minimum_detectable(double standard_error, double freedom, double alpha, double power) {
    if (standard_error == 0) {
        return 0;
    }
    return (student_quantile(1 - alpha / 2, freedom) + student_quantile(power, freedom)) * standard_error;
}

}  // namespace diptych::core
