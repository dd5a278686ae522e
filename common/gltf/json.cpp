#include "gltf/json.h"

#include "error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace diptych::core::gltf {
namespace {

/// KHR_texture_transform: (u', v') = offset + R·S·(u, v), R turning counter-clockwise in an image whose v points down.
Json json_transform(const TextureSlot& slot, const std::string& material) {
    const glm::dvec2 u_axis(slot.u_row.x, slot.v_row.x), v_axis(slot.u_row.y, slot.v_row.y);
    const glm::dvec2 offset(slot.u_row.z, slot.v_row.z);
    const double angle = std::atan2(-u_axis.y, u_axis.x);
    const double scale_u = glm::length(u_axis);
    const double scale_v = v_axis.x * std::sin(angle) + v_axis.y * std::cos(angle);
    const glm::dvec2 rebuilt(scale_v * std::sin(angle), scale_v * std::cos(angle));
    if (glm::length(rebuilt - v_axis) > 1e-5 * (scale_u + glm::length(v_axis))) {
        throw Error("material '" + material + "': a sheared texture transform cannot be written as glTF");
    }
    Json out;
    if (offset != glm::dvec2(0)) {
        out["offset"] = json_vector(glm::vec2(offset));
    }
    if (angle != 0) {
        out["rotation"] = decimal(float(angle));
    }
    if (scale_u != 1 || scale_v != 1) {
        out["scale"] = json_vector(glm::vec2(scale_u, scale_v));
    }
    return out;
}

void add_slot(Json& parent, const char* key, const TextureSlot& slot, const std::string& material,
              std::set<std::string>& extensions) {
    if (slot.texture == none) {
        return;
    }
    Json& out = parent[key];
    out["index"] = slot.texture;
    if (slot.uv_set != 0) {
        out["texCoord"] = slot.uv_set;
    }
    if (slot.u_row != glm::vec3(1, 0, 0) || slot.v_row != glm::vec3(0, 1, 0)) {
        extensions.insert("KHR_texture_transform");
        out["extensions"]["KHR_texture_transform"] = json_transform(slot, material);
    }
}

float max_component(const glm::vec3& v) {
    return std::max({v.x, v.y, v.z});
}

void add_emission(Json& out, const Material& material, std::set<std::string>& extensions) {
    const float strongest = max_component(material.emission);
    if (material.moving_emission) {
        extensions.insert("KHR_materials_emissive_strength");
        const float strength = material.moving_emission->strength;
        out["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = decimal(strength);
        out["emissiveFactor"] = json_vector(material.moving_emission->factor);
    } else if (strongest > 1) {
        extensions.insert("KHR_materials_emissive_strength");
        out["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = decimal(strongest);
        out["emissiveFactor"] = json_vector(material.emission / strongest);
    } else if (strongest > 0) {
        out["emissiveFactor"] = json_vector(material.emission);
    }
    add_slot(out, "emissiveTexture", material.emission_texture, material.name, extensions);
}

void add_specular(Json& out, const Material& material, std::set<std::string>& extensions) {
    if (material.ior != 1.5F) {
        extensions.insert("KHR_materials_ior");
        out["extensions"]["KHR_materials_ior"]["ior"] = decimal(material.ior);
    }
    Json specular;
    if (material.specular != 1) {
        specular["specularFactor"] = decimal(material.specular);
    }
    add_slot(specular, "specularTexture", material.specular_texture, material.name, extensions);
    if (material.specular_color != glm::vec3(1)) {
        specular["specularColorFactor"] = json_vector(material.specular_color);
    }
    add_slot(specular, "specularColorTexture", material.specular_color_texture, material.name, extensions);
    if (!specular.empty()) {
        extensions.insert("KHR_materials_specular");
        out["extensions"]["KHR_materials_specular"] = specular;
    }
}

}  // namespace

double decimal(float value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    double out = 0;
    std::from_chars(text.data(), end, out);
    return out + 0.0;
}

Json json_material(const Material& material, std::set<std::string>& extensions) {
    Json out;
    if (!material.name.empty()) {
        out["name"] = material.name;
    }
    Json surface;
    if (material.base_color != glm::vec4(1)) {
        surface["baseColorFactor"] = json_vector(material.base_color);
    }
    add_slot(surface, "baseColorTexture", material.base_color_texture, material.name, extensions);
    if (material.metallic != 1) {
        surface["metallicFactor"] = decimal(material.metallic);
    }
    if (material.roughness != 1) {
        surface["roughnessFactor"] = decimal(material.roughness);
    }
    add_slot(surface, "metallicRoughnessTexture", material.metallic_roughness_texture, material.name, extensions);
    if (!surface.empty()) {
        out["pbrMetallicRoughness"] = surface;
    }
    add_slot(out, "normalTexture", material.normal_texture, material.name, extensions);
    if (material.normal_texture.texture != none && material.normal_scale != 1) {
        out["normalTexture"]["scale"] = decimal(material.normal_scale);
    }
    add_emission(out, material, extensions);
    add_specular(out, material, extensions);
    if (material.alpha_mode == AlphaMode::mask) {
        out["alphaMode"] = "MASK";
        if (material.alpha_cutoff != 0.5F) {
            out["alphaCutoff"] = decimal(material.alpha_cutoff);
        }
    } else if (material.alpha_mode == AlphaMode::blend) {
        out["alphaMode"] = "BLEND";
    }
    if (material.double_sided) {
        out["doubleSided"] = true;
    }
    if (material.unlit) {
        extensions.insert("KHR_materials_unlit");
        out["extensions"]["KHR_materials_unlit"] = Json::object();
    }
    if (out.is_null()) {
        out = Json::object();
    }
    return out;
}

Json json_light(const PunctualLight& light) {
    Json out;
    if (!light.name.empty()) {
        out["name"] = light.name;
    }
    // A light that is dark at rest keeps its colour for when it is not.
    const float strongest = light.moving_color && max_component(*light.moving_color) > 0
                                ? max_component(light.intensity) / max_component(*light.moving_color)
                                : max_component(light.intensity);
    switch (light.type) {
    case PunctualType::point:
        out["type"] = "point";
        break;
    case PunctualType::directional:
        out["type"] = "directional";
        break;
    case PunctualType::spot:
        out["type"] = "spot";
        out["spot"]["innerConeAngle"] = light.inner_cone;
        out["spot"]["outerConeAngle"] = light.outer_cone;
        break;
    }
    if (light.moving_color) {
        out["color"] = json_vector(*light.moving_color);
    } else if (strongest > 0) {
        out["color"] = json_vector(light.intensity / strongest);
    }
    out["intensity"] = decimal(strongest);
    return out;
}

Json json_camera(const Camera& camera) {
    Json out;
    if (!camera.name.empty()) {
        out["name"] = camera.name;
    }
    if (camera.orthographic) {
        const double half = camera.orthographic_height / 2;
        out["type"] = "orthographic";
        out["orthographic"] = {
            {"xmag", half * camera.aspect.value_or(1)}, {"ymag", half}, {"zfar", 1e4}, {"znear", 0.0}};
    } else {
        out["type"] = "perspective";
        Json& lens = out["perspective"];
        if (camera.aspect) {
            lens["aspectRatio"] = *camera.aspect;
        }
        lens["yfov"] = camera.vertical_fov;
        lens["znear"] = 0.001;
    }
    return out;
}

void place(Json& node, const glm::dmat4& to_world) {
    glm::dmat4 plain(1);
    for (int i = 0; i < 3; ++i) {
        plain[i][i] = to_world[i][i];
    }
    plain[3] = to_world[3];
    if (to_world == glm::dmat4(1)) {
        return;
    }
    if (to_world == plain && to_world[0][0] > 0 && to_world[1][1] > 0 && to_world[2][2] > 0) {
        if (glm::dvec3(to_world[3]) != glm::dvec3(0)) {
            node["translation"] = json_vector(glm::dvec3(to_world[3]));
        }
        const glm::dvec3 scale(to_world[0][0], to_world[1][1], to_world[2][2]);
        if (scale != glm::dvec3(1)) {
            node["scale"] = json_vector(scale);
        }
        return;
    }
    Json matrix = Json::array();
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            matrix.push_back(to_world[column][row] + 0.0);
        }
    }
    node["matrix"] = matrix;
}

}  // namespace diptych::core::gltf
