// The length units of bottom levels, chosen so that drivers can invert the matrices of instances
// (docs/decisions/0016-units-of-bottom-levels.md).
#pragma once

#include <vector>

#include "structures/instance_groups.h"
#include "pack/packed_scene.h"

namespace diptych::core {

/// Of each mesh, a power of two: its bottom level holds its vertices divided by the unit, and the matrices of its
/// instances are multiplied by it. Both are exact, so a unit changes no result but the rounding of the inverse matrix.
///
/// An instance's matrix is [A t]. Drivers may invert it as a 4x4 matrix by elimination (lavapipe does), which chooses
/// pivots by size: where an entry of t is larger than A's, it becomes a pivot, and A's inverse is rounded to
/// ulps of |t| / |A|. A mesh of 300 units then leans by 0.01 of them, more than any ray is offset. In the unit chosen
/// here A's entries are larger than t's, with room for instances and cameras that move.
std::vector<float> mesh_units(const PackedScene& packed, const InstanceGroups& groups);

}  // namespace diptych::core
