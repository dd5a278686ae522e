#include <algorithm>
#include <cmath>
#include <numbers>

#include "pack/alias_table_build.h"
#include "pack/emission_mean.h"
#include "pack/features.h"
#include "pack/pack_parts.h"
#include "pack/range.h"

namespace diptych::core {
namespace {

constexpr double pi = std::numbers::pi;

/// Share of picks that goes to every light alike, so that no light which outshines its power where it stands is
/// starved.
constexpr double defensive_share = 0.05;

glm::dvec3 world_position(const shared::Instance& i, const glm::vec3& p) {
    const glm::dvec4 q(p, 1);
    return {glm::dot(glm::dvec4(i.row_0), q), glm::dot(glm::dvec4(i.row_1), q), glm::dot(glm::dvec4(i.row_2), q)};
}

bool is_emissive(const PackedScene& packed, std::uint32_t geometry) {
    return (packed.materials[packed.geometries[geometry].material].flags & shared::MATERIAL_EMISSIVE) != 0;
}

/// Which light each emissive triangle is: instance by instance, geometry by geometry, triangle by triangle, in order.
void lay_out_emitters(PackedScene& packed) {
    for (std::size_t i = 0; i < packed.instances.size(); ++i) {
        const MeshRange range = packed.meshes[packed.instance_meshes[i]];
        const std::uint32_t end = range.first_geometry + range.geometry_count;
        bool any = false;
        for (std::uint32_t g = range.first_geometry; g < end; ++g) {
            any = any || is_emissive(packed, g);
        }
        if (!any) {
            continue;
        }
        packed.instances[i].first_emitter_slot = static_cast<std::uint32_t>(packed.emitter_slots.size());
        for (std::uint32_t g = range.first_geometry; g < end; ++g) {
            const auto first = static_cast<std::uint32_t>(packed.emissive_triangles.size());
            packed.emitter_slots.push_back(is_emissive(packed, g) ? first : shared::NONE);
            const std::uint32_t count = is_emissive(packed, g) ? packed.geometry_extents[g].triangle_count : 0;
            for (std::uint32_t t = 0; t < count; ++t) {
                shared::EmissiveTriangle light{};
                light.geometry = g;
                light.primitive = t;
                packed.emissive_triangles.push_back(light);
            }
        }
    }
}

/// One geometry of one instance, whose lights begin at `first`.
void place_geometry(PackedScene& packed, std::size_t instance_index, std::uint32_t geometry_index, std::uint32_t first,
                    bool materials_changed) {
    const shared::Instance& instance = packed.instances[instance_index];
    const shared::Geometry& geometry = packed.geometries[geometry_index];
    const shared::Material& material = packed.materials[geometry.material];
    const bool shown = packed.instance_shown[instance_index] != 0;
    const bool unlit = (material.flags & shared::MATERIAL_UNLIT) != 0;
    const std::uint32_t slot = unlit ? material.base_color_slot : material.emission_slot;
    const std::uint32_t alpha = shared::MATERIAL_ALPHA_MASK | shared::MATERIAL_ALPHA_BLEND;
    const bool varies =
        slot != shared::NONE || (material.flags & alpha) != 0 || (unlit && geometry.first_color != shared::NONE);
    const bool two_sided = (material.flags & shared::MATERIAL_DOUBLE_SIDED) != 0;
    const EmissionMean emission(packed);
    for (std::uint32_t t = 0; t < packed.geometry_extents[geometry_index].triangle_count; ++t) {
        const glm::uvec3 triangle = packed.triangles[geometry.first_triangle + t];
        const auto corner = [&](std::uint32_t v) {
            return world_position(instance, packed.positions[geometry.first_vertex + v]);
        };
        const glm::dvec3 a = corner(triangle.x);
        const glm::dvec3 edge_1 = corner(triangle.y) - a;
        const glm::dvec3 edge_2 = corner(triangle.z) - a;
        shared::EmissiveTriangle& light = packed.emissive_triangles[first + t];
        light.vertex_0 = a;
        light.edge_1 = edge_1;
        light.edge_2 = edge_2;
        light.flags = (two_sided ? shared::EMITTER_TWO_SIDED : 0U) | (varies ? shared::EMITTER_VARIES : 0U);
        light.radiance = unlit ? glm::vec3(material.base_color) : material.emission;
        double& mean = packed.emitter_means[first + t];
        if (materials_changed) {
            mean = varies ? emission.luminance(light) : luminance(glm::dvec3(light.radiance));
        }
        // In fp32, as the samplers will see it: what has no area there is no light.
        const bool has_area = shown && glm::length(glm::cross(light.edge_1, light.edge_2)) > 0;
        // Of the rounded edges, which span the triangle that is sampled.
        const glm::dvec3 normal = glm::cross(glm::dvec3(light.edge_1), glm::dvec3(light.edge_2));
        const double double_area = glm::length(normal);
        light.front = double_area > 0 ? normal * ((instance.mirrored != 0 ? -1 : 1) / double_area) : normal;
        light.double_area = static_cast<float>(double_area);
        // A texture's samples may all miss what is bright: the material's own factor keeps such a light alive.
        const double floor = varies ? 1e-3 * luminance(glm::dvec3(light.radiance)) : 0;
        const double power = std::max(mean, floor) * 0.5 * double_area * pi * (two_sided ? 2 : 1);
        packed.light_powers[first + t] = has_area ? power : 0.0;
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

// A point of an emitter at distance r, of radiance L, is picked with probability p per area, and then stands for
// f cos cos' L / (p r^2). Picking is by power, so L / p is one number S for the whole scene, the defensive share aside.
// Where r^2 is S / L, L the emitters' mean radiance, that is f cos cos' L: about as much as material sampling gives it.
void find_reach(PackedScene& packed) {
    double power = 0;
    double brightness = 0;  // power times radiance
    double share = 0;
    for (std::size_t i = 0; i < packed.emissive_triangles.size(); ++i) {
        const shared::EmissiveTriangle& light = packed.emissive_triangles[i];
        const double own = packed.light_powers[i];
        if (own > 0) {
            power += own / pi;
            brightness += own / pi * (own / (pi * 0.5 * static_cast<double>(light.double_area)));
            share += static_cast<double>(light.pmf);
        }
    }
    shared::ResamplingConstants& resampling = packed.constants.resampling;
    resampling.reach = brightness > 0 ? static_cast<float>(power / std::sqrt(share * brightness)) : 0;
}

}  // namespace

void place_emitters(PackedScene& packed, std::size_t instance, bool materials_changed) {
    const MeshRange range = packed.meshes[packed.instance_meshes[instance]];
    const std::uint32_t slots = packed.instances[instance].first_emitter_slot;
    for (std::uint32_t g = 0; slots != shared::NONE && g < range.geometry_count; ++g) {
        if (packed.emitter_slots[slots + g] != shared::NONE) {
            place_geometry(packed, instance, range.first_geometry + g, packed.emitter_slots[slots + g],
                           materials_changed);
        }
    }
}

void place_punctual_lights(const Scene& scene, PackedScene& packed) {
    std::vector<double>& powers = packed.light_powers;
    const bool has_sky = powers.size() > packed.emissive_triangles.size() + packed.punctual_lights.size();
    const double sky = has_sky ? powers.back() : 0;
    powers.resize(packed.emissive_triangles.size());
    packed.punctual_lights.clear();
    for (const PunctualLight& light : scene.lights) {
        shared::PunctualLight out{};
        out.position = glm::dvec3(light.light_to_world[3]) - packed.origin;
        require_near(scene, "light '" + light.name + "'", "stands",
                     light.type == PunctualType::directional ? 0 : glm::length(glm::dvec3(out.position)));
        out.direction = -glm::normalize(glm::dvec3(light.light_to_world[2]));
        out.intensity = light.intensity;
        out.part = shared::NONE;
        const double strength = luminance(glm::dvec3(light.intensity));
        switch (light.type) {
        case PunctualType::point:
            out.type = shared::PUNCTUAL_POINT;
            powers.push_back(4 * pi * strength);
            break;
        case PunctualType::spot:
            out.type = shared::PUNCTUAL_SPOT;
            pack_spot_cone(light, out);
            powers.push_back(2 * pi * strength * (1 - 0.5 * (std::cos(light.inner_cone) + std::cos(light.outer_cone))));
            break;
        case PunctualType::directional:
            out.type = shared::PUNCTUAL_DIRECTIONAL;
            powers.push_back(pi * packed.radius * packed.radius * strength);
            break;
        }
        packed.punctual_lights.push_back(out);
    }
    if (has_sky) {
        powers.push_back(sky);
    }
}

void weigh_lights(PackedScene& packed) {
    shared::RenderConstants& constants = packed.constants;
    std::vector<double>& powers = packed.light_powers;
    powers.resize(packed.emissive_triangles.size() + packed.punctual_lights.size());
    // Material sampling finds every light but the punctual ones by itself.
    const bool samples_environment =
        shared::samples_lights(constants.integrator) && packed.environment_luminance > 0;
    if (samples_environment) {
        powers.push_back(4 * pi * pi * packed.radius * packed.radius * packed.environment_luminance);
    }
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
    } else {
        packed.light_table.assign(packed.moves ? powers.size() : 0, {1, 0});
    }
    constants.light_count = any ? static_cast<std::uint32_t>(packed.light_table.size()) : 0;
    constants.emissive_triangle_count = static_cast<std::uint32_t>(packed.emissive_triangles.size());
    constants.punctual_light_count = static_cast<std::uint32_t>(packed.punctual_lights.size());
    weigh_clusters(packed);
    weigh_light_tree(packed);
    find_reach(packed);
}

void pack_lights(const Scene& scene, const RenderSettings& settings, PackedScene& packed) {
    if (shared::samples_lights(packed.constants.integrator)) {
        lay_out_emitters(packed);
    }
    packed.emitter_means.resize(packed.emissive_triangles.size());
    packed.light_powers.resize(packed.emissive_triangles.size());
    for (std::size_t i = 0; i < packed.instances.size(); ++i) {
        place_emitters(packed, i, true);
    }
    const bool asks_size = !scene.lights.empty() || packed.environment_luminance > 0;
    packed.radius = asks_size ? scene_radius(packed) : 1.0;
    place_punctual_lights(scene, packed);
    require_indexable(scene, packed.light_powers.size() + 1, "lights");
    weigh_lights(packed);
    if (shared::resamples_lights(packed.constants.integrator)) {
        cluster_lights(packed);
        weigh_clusters(packed);
    }
    choose_light_sampler(settings.light_sampler, packed);
}

}  // namespace diptych::core
