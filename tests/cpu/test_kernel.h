// The shading kernel of the CPU backend as tests call it: compiled with all features, and with the tests' own options.
#pragma once

#include "backend/cpu_kernel.h"

namespace diptych::core::tests {

/// A type of the tests alone, so that no linker takes the library's kernel, compiled with other options, for this one.
struct Tracer : PlainTracer {};
using Kernel = shared::CpuKernel<Tracer, ~0U>;

}  // namespace diptych::core::tests
