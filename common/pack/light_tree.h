// Builds the light tree (shared_glsl_cpp/lights/light_tree.h): its form once, and what its nodes emit at each moment.
#pragma once

#include "pack/packed_scene.h"

namespace diptych::core {

/// What lights emit together, and from where.
struct LightEmission {
    double weight = 0;  // four times the irradiance at a distance of 1 m where both cosines are 1
    glm::dvec3 center{0};
    double spread = 0;
    glm::dvec3 axis{0};
    double front = 0;

    void add(const LightEmission& other);
};

LightEmission emission_of(const PackedScene& packed, std::size_t light);

/// Whether a light stands at infinity: directional lights and the environment.
bool is_distant(const PackedScene& packed, std::size_t light);

/// Number of emissive triangles and punctual lights, and the id of the environment.
inline std::size_t nearby_lights(const PackedScene& packed) {
    return packed.emissive_triangles.size() + packed.punctual_lights.size();
}

/// Forms the tree: which lights are together, and where each light and each node is. There is no tree for fewer than two
/// lights.
void form_light_tree(PackedScene& packed);

}  // namespace diptych::core
