// The parts of a glTF document that need no buffer: materials, cameras, lights, placements. For gltf/write.cpp.
#pragma once

#include "scene/scene.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace diptych::core::gltf {

using Json = nlohmann::ordered_json;

/// The shortest decimal that names this float, so that 0.2F is written 0.2; -0 is written 0.
double decimal(float value);

template <typename Vector>
Json json_vector(const Vector& v) {
    Json out = Json::array();
    for (int i = 0; i < v.length(); ++i) {
        if constexpr (std::is_same_v<typename Vector::value_type, float>) {
            out.push_back(decimal(v[i]));
        } else {
            out.push_back(v[i] + 0.0);
        }
    }
    return out;
}

/// Each records the extensions that it uses in `extensions`.
Json json_material(const Material& material, std::set<std::string>& extensions);
Json json_light(const PunctualLight& light);
Json json_camera(const Camera& camera);

/// Adds a placement to a node: nothing, `translation`, `translation` and `scale`, or the whole `matrix`.
void place(Json& node, const glm::dmat4& to_world);

}  // namespace diptych::core::gltf
