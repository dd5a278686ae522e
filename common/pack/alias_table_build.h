// Building what alias_table.h picks from.
#pragma once

#include <span>
#include <vector>

#include "language/scene_types.h"

namespace diptych::core {

/// Probabilities of picking each of `weights`, in double: `defensive` of the whole is spread evenly over the positive
/// ones, the rest goes by weight. Weights are scaled by their maximum first, so that no range overflows; NaN and
/// negative count as 0. All zero where no weight is positive.
std::vector<double> pick_probabilities(std::span<const double> weights, double defensive);

/// Alias table (Walker 1977) of probabilities that sum to 1, by Vose's linear-time construction (1991), in double.
std::vector<shared::AliasEntry> build_alias_table(std::span<const double> probabilities);

}  // namespace diptych::core
