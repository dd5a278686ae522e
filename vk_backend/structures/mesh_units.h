// Length units of bottom levels, chosen so that drivers can invert the matrices of instances
// (docs/decisions/0016-units-of-bottom-levels.md).
#pragma once

#include <vector>

#include "structures/instance_groups.h"
#include "pack/packed_scene.h"

namespace diptych::core {

/// The unit of each mesh, a power of two. The bottom level holds vertices divided by the unit, and the matrices of its
/// instances are multiplied by it. Both operations are exact, so a unit changes only the rounding of the inverse
/// matrix.
///
/// An instance's matrix is [A t]. A driver may invert it as a 4x4 matrix by elimination with pivots chosen by size
/// (lavapipe does). If an entry of t is larger than those of A, it becomes a pivot, and the inverse of A has errors of
/// some ulps of |t| / |A|. A mesh of 300 units then tilts by 0.01 units, which exceeds the offset of rays. In the unit
/// chosen here the entries of A are larger than those of t, with a margin for instances and cameras that move.
std::vector<float> mesh_units(const PackedScene& packed, const InstanceGroups& groups);

}  // namespace diptych::core
