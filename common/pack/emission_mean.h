// How bright a textured light is on average, for the table that picks lights by power.
#pragma once

#include "pack/packed_scene.h"

namespace diptych::core {

/// Evaluates emission with the shared kernels, on the host.
class EmissionMean {
public:
    /// Keeps a reference: geometry, materials and textures must be packed by now and stay.
    explicit EmissionMean(const PackedScene& packed) : packed_(packed) {}

    /// Mean luminance of the radiance that a light emits, over its area, coverage included.
    double luminance(const shared::EmissiveTriangle& light) const;

private:
    const PackedScene& packed_;
};

}  // namespace diptych::core
