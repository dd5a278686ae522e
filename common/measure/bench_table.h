// What a bench found, as a table for people.
#pragma once

#include <string>

#include "measure/bench.h"

namespace diptych::core {

/// Lines, each with its end: a line for each integrator, and one for each of its passes.
std::string bench_table(const BenchResult& result, int width, int height);

}  // namespace diptych::core
