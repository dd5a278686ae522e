// Are numbers spread evenly over [0, 1]?
#pragma once

#include <vector>

namespace diptych::core {

struct KolmogorovSmirnov {
    double distance = 0;  // largest between the empirical and the uniform distribution functions
    double p = 1;  // of a distance as large: Kolmogorov's limit at (sqrt(n) + 0.12 + 0.11/sqrt(n)) D (Stephens 1970)
};

/// p is good to about 1 % from n = 20 on.
KolmogorovSmirnov kolmogorov_smirnov_uniform(std::vector<double> values);

}  // namespace diptych::core
