#include "pack/emitter_corners.h"

#include <limits>

namespace diptych::core {
namespace {

/// As may_be_passed (emitter.kernel.h) tells shaders: what they think could be found must be found.
bool may_be_passed(const PackedScene& packed, const shared::EmissiveTriangle& light) {
    const std::uint32_t needed = shared::FEATURE_ALPHA | shared::FEATURE_EMISSIVE_TEXTURES;
    const std::uint32_t flags = packed.materials[packed.geometries[light.geometry].material].flags;
    return (packed.features & needed) == needed && (light.flags & shared::EMITTER_VARIES) != 0 &&
           (flags & (shared::MATERIAL_ALPHA_MASK | shared::MATERIAL_ALPHA_BLEND)) != 0;
}

}  // namespace

bool searches_emitters(const PackedScene& packed) {
    const shared::RenderConstants& c = packed.constants;
    return shared::resamples_lights(c.integrator) && c.resampling.bsdf_candidates != 0 && c.max_depth > 0 &&
           c.emissive_triangle_count > 0;
}

std::vector<shared::vec3> emitter_corners(const PackedScene& packed) {
    std::vector<shared::vec3> corners;
    corners.reserve(3 * packed.emissive_triangles.size());
    for (const shared::EmissiveTriangle& light : packed.emissive_triangles) {
        const bool findable = light.pmf > 0 && !may_be_passed(packed, light);
        const float kept = findable ? 1 : MUTANT(EMITTERS_LEFT_OUT_AS_NAN, 0.0F, std::numeric_limits<float>::quiet_NaN());
        corners.push_back(light.vertex_0);
        corners.push_back(light.vertex_0 + kept * light.edge_1);
        corners.push_back(light.vertex_0 + kept * light.edge_2);
    }
    return corners;
}

}  // namespace diptych::core
