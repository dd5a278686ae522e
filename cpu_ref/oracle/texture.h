// Textures in double: glTF 2.0 section 3.8, as docs/integrand.md narrows it.
#pragma once

#include "oracle/world.h"

namespace diptych::core::oracle {

enum class Encoding { linear, srgb };

/// The sRGB curve (IEC 61966-2-1), [0, 1] to [0, 1].
double decode_srgb(double encoded);

/// The slot's texture at a point of a triangle; `missing` where the slot is empty.
dvec4 sample_texture(const Scene& scene, const TextureSlot& slot, const Triangle& triangle, dvec2 barycentrics,
                     Encoding encoding, const dvec4& missing = dvec4(1));

}  // namespace diptych::core::oracle
