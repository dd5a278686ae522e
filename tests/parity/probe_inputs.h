// Arguments for the probes.
#pragma once

#include <cstdint>
#include <vector>

#include "probe.h"

namespace diptych::core::tests {

/// Deterministic. Every eighth takes most of its fields from tables of edges, the rest are random.
std::vector<shared::ProbeInput> make_probe_inputs(std::uint32_t seed, std::uint32_t count);

}  // namespace diptych::core::tests
