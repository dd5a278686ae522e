#include <algorithm>
#include <cmath>
#include <numbers>

#include "pack/alias_table_build.h"
#include "pack/emission_mean.h"
#include "pack/features.h"
#include "pack/pack_parts.h"

namespace diptych {
namespace {

constexpr double pi = std::numbers::pi;

/// Share of picks that goes to every light alike, so that no light which outshines its power where it stands is starved.
constexpr double defensive_share = 0.05;

double luminance(const glm::dvec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

glm::dvec3 world_position(const shared::Instance& i, const glm::vec3& p) {
    const glm::dvec4 q(p, 1);
    return {glm::dot(glm::dvec4(i.row_0), q), glm::dot(glm::dvec4(i.row_1), q), glm::dot(glm::dvec4(i.row_2), q)};
}

/// One geometry of one instance, triangle by triangle, in order: light id = first id + triangle. Returns the powers' luminances.
void add_emitters(const shared::Instance& instance, std::uint32_t geometry_index, std::uint32_t triangle_count,
                  const EmissionMean& emission, PackedScene& packed, std::vector<double>& powers) {
    const shared::Geometry& geometry = packed.geometries[geometry_index];
    const shared::Material& material = packed.materials[geometry.material];
    const bool unlit = (material.flags & shared::MATERIAL_UNLIT) != 0;
    const std::uint32_t slot = unlit ? material.base_color_slot : material.emission_slot;
    const std::uint32_t alpha = shared::MATERIAL_ALPHA_MASK | shared::MATERIAL_ALPHA_BLEND;
    const bool varies = slot != shared::NONE || (material.flags & alpha) != 0 ||
                        (unlit && geometry.first_color != shared::NONE);
    const bool two_sided = (material.flags & shared::MATERIAL_DOUBLE_SIDED) != 0;
    for (std::uint32_t t = 0; t < triangle_count; ++t) {
        const glm::uvec3 triangle = packed.triangles[geometry.first_triangle + t];
        const auto corner = [&](std::uint32_t v) {
            return world_position(instance, packed.positions[geometry.first_vertex + v]);
        };
        const glm::dvec3 a = corner(triangle.x);
        const glm::dvec3 edge_1 = corner(triangle.y) - a;
        const glm::dvec3 edge_2 = corner(triangle.z) - a;
        shared::EmissiveTriangle light{};
        light.vertex_0 = a;
        light.edge_1 = edge_1;
        light.edge_2 = edge_2;
        light.flags = (two_sided ? shared::EMITTER_TWO_SIDED : 0U) |
                      (instance.mirrored != 0 ? shared::EMITTER_MIRRORED : 0U) |
                      (varies ? shared::EMITTER_VARIES : 0U);
        light.geometry = geometry_index;
        light.primitive = t;
        light.radiance = unlit ? glm::vec3(material.base_color) : material.emission;
        // In fp32, as the samplers will see it: what has no area there is no light.
        const bool has_area = glm::length(glm::cross(light.edge_1, light.edge_2)) > 0;
        const double area = 0.5 * glm::length(glm::cross(edge_1, edge_2));
        const double mean = varies ? emission.luminance(light) : luminance(glm::dvec3(light.radiance));
        // A texture's samples may all miss what is bright: the material's own factor keeps such a light alive.
        const double floor = varies ? 1e-3 * luminance(glm::dvec3(light.radiance)) : 0;
        powers.push_back(has_area ? std::max(mean, floor) * area * pi * (two_sided ? 2 : 1) : 0.0);
        packed.emissive_triangles.push_back(light);
    }
}

void pack_emitters(PackedScene& packed, std::vector<double>& powers) {
    const EmissionMean emission(packed);
    for (std::size_t i = 0; i < packed.instances.size(); ++i) {
        const MeshRange range = packed.meshes[packed.instance_meshes[i]];
        const auto emissive = [&](std::uint32_t geometry) {
            return (packed.materials[packed.geometries[geometry].material].flags & shared::MATERIAL_EMISSIVE) != 0;
        };
        bool any = false;
        for (std::uint32_t g = 0; g < range.geometry_count; ++g) {
            any = any || emissive(range.first_geometry + g);
        }
        if (!any) {
            continue;
        }
        packed.instances[i].first_emitter_slot = static_cast<std::uint32_t>(packed.emitter_slots.size());
        for (std::uint32_t g = 0; g < range.geometry_count; ++g) {
            const std::uint32_t geometry = range.first_geometry + g;
            packed.emitter_slots.push_back(emissive(geometry)
                                               ? static_cast<std::uint32_t>(packed.emissive_triangles.size())
                                               : shared::NONE);
            if (emissive(geometry)) {
                add_emitters(packed.instances[i], geometry, packed.geometry_extents[geometry].triangle_count, emission,
                             packed, powers);
            }
        }
    }
}

double scene_radius(const PackedScene& packed) {
    glm::dvec3 lo(1e300);
    glm::dvec3 hi(-1e300);
    for (std::size_t i = 0; i < packed.instances.size(); ++i) {
        const MeshRange range = packed.meshes[packed.instance_meshes[i]];
        for (std::uint32_t g = range.first_geometry; g < range.first_geometry + range.geometry_count; ++g) {
            const std::uint32_t first = packed.geometries[g].first_vertex;
            for (std::uint32_t v = first; v < first + packed.geometry_extents[g].vertex_count; ++v) {
                const glm::dvec3 p = world_position(packed.instances[i], packed.positions[v]);
                lo = glm::min(lo, p);
                hi = glm::max(hi, p);
            }
        }
    }
    return packed.instances.empty() ? 1.0 : std::max(0.5 * glm::length(hi - lo), 1e-30);
}

/// KHR_lights_punctual's falloff between the cones, as one multiply-add.
void pack_spot_cone(const PunctualLight& light, shared::PunctualLight& out) {
    const double cos_outer = std::cos(light.outer_cone);
    const double cos_inner = std::cos(light.inner_cone);
    const double scale = 1 / std::max(0.001, cos_inner - cos_outer);
    out.cone_scale = static_cast<float>(scale);
    out.cone_offset = static_cast<float>(-cos_outer * scale);
}

void pack_punctual(const Scene& scene, const glm::dvec3& origin, double radius, PackedScene& packed,
                   std::vector<double>& powers) {
    for (const PunctualLight& light : scene.lights) {
        shared::PunctualLight out{};
        out.position = glm::dvec3(light.light_to_world[3]) - origin;
        out.direction = -glm::normalize(glm::dvec3(light.light_to_world[2]));
        out.intensity = light.intensity;
        const double strength = luminance(glm::dvec3(light.intensity));
        switch (light.type) {
            case PunctualType::point:
                out.type = shared::PUNCTUAL_POINT;
                powers.push_back(4 * pi * strength);
                break;
            case PunctualType::spot:
                out.type = shared::PUNCTUAL_SPOT;
                pack_spot_cone(light, out);
                powers.push_back(2 * pi * strength *
                                 (1 - 0.5 * (std::cos(light.inner_cone) + std::cos(light.outer_cone))));
                break;
            case PunctualType::directional:
                out.type = shared::PUNCTUAL_DIRECTIONAL;
                powers.push_back(pi * radius * radius * strength);
                break;
        }
        packed.punctual_lights.push_back(out);
    }
}

}  // namespace

void pack_lights(const Scene& scene, const RenderSettings& settings, const glm::dvec3& origin,
                 double environment_luminance, PackedScene& packed) {
    shared::RenderConstants& constants = packed.constants;
    // Material sampling finds every light but the punctual ones by itself.
    const bool samples_all = settings.integrator != Integrator::brdf;
    std::vector<double> powers;
    if (samples_all) {
        pack_emitters(packed, powers);
    }
    const double radius = scene.lights.empty() && environment_luminance == 0 ? 1.0 : scene_radius(packed);
    pack_punctual(scene, origin, radius, packed, powers);
    const bool samples_environment = samples_all && environment_luminance > 0;
    if (samples_environment) {
        powers.push_back(4 * pi * pi * radius * radius * environment_luminance);
    }
    require_indexable(scene, powers.size(), "lights");

    const std::vector<double> pmf = pick_probabilities(powers, defensive_share);
    std::size_t next = 0;
    for (shared::EmissiveTriangle& light : packed.emissive_triangles) {
        light.pmf = static_cast<float>(pmf[next++]);
    }
    for (shared::PunctualLight& light : packed.punctual_lights) {
        light.pmf = static_cast<float>(pmf[next++]);
    }
    if (samples_environment) {
        constants.environment.pmf = static_cast<float>(pmf[next]);
    }
    const bool any = std::any_of(pmf.begin(), pmf.end(), [](double p) { return p > 0; });
    if (any) {
        packed.light_table = build_alias_table(pmf);
    }
    constants.light_count = static_cast<std::uint32_t>(packed.light_table.size());
    constants.emissive_triangle_count = static_cast<std::uint32_t>(packed.emissive_triangles.size());
    constants.punctual_light_count = static_cast<std::uint32_t>(packed.punctual_lights.size());
}

}  // namespace diptych
