#include <algorithm>
#include <cstring>

#include "error.h"
#include "pack/pack_parts.h"
#include "pack/range.h"

namespace diptych::core {
namespace {

void require_same(const Scene& scene, std::size_t now, std::size_t then, const char* what) {
    if (now != then) {
        throw Error(scene.name + ": " + what + ": " + std::to_string(now) + " where the moment before had " +
                    std::to_string(then));
    }
}

/// The environment's tables hold for any scale that is a multiple of the one they were built under, but 0.
void require_same_tint(const Scene& scene, const PackedScene& packed) {
    const glm::vec3 off = environment_tint(scene.environment) - packed.environment_tint;
    if (glm::dot(off, off) > 1e-10F) {
        throw Error(scene.name + ": environment: is of another tint than at the moment before, or was dark");
    }
}

/// Which materials' emission is another now.
std::vector<bool> move_materials(const Scene& scene, PackedScene& packed) {
    std::vector<bool> changed(packed.materials.size(), false);
    for (std::size_t i = 0; i < packed.materials.size(); ++i) {
        glm::vec3& emission = packed.materials[i].emission;
        changed[i] = emission != scene.materials[i].emission;
        emission = scene.materials[i].emission;
    }
    return changed;
}

/// How far away anything is now. Throws Error where that is too far.
double reach_now(const Scene& scene, const PackedScene& packed) {
    double reach = packed.reach;
    for (std::size_t i = 0; i < packed.instances.size(); ++i) {
        const Instance& instance = scene.instances[packed.scene_instances[i]];
        const MeshFrame& frame = packed.mesh_frames[packed.instance_meshes[i]];
        if (instance.node == none) {
            continue;
        }
        const double own = reach_of(frame, instance.object_to_world, packed.origin);
        require_near(scene, "instance '" + instance.name + "'", "reaches", own);
        reach = std::max(reach, own);
    }
    return reach;
}

/// Which instances stand elsewhere now.
std::vector<bool> move_instances(const Scene& scene, PackedScene& packed) {
    const double reach = reach_now(scene, packed);
    packed.least_unit = 1;
    std::vector<bool> changed(packed.instances.size(), false);
    for (std::size_t i = 0; i < packed.instances.size(); ++i) {
        shared::Instance next = packed.instances[i];
        const std::optional<double> unit =
            place_instance(scene.instances[packed.scene_instances[i]], packed.origin,
                           packed.mesh_frames[packed.instance_meshes[i]], reach, next);
        packed.least_unit = std::min(packed.least_unit, unit.value_or(1));
        changed[i] = std::memcmp(&next, &packed.instances[i], sizeof next) != 0 ||
                     unit.has_value() != (packed.instance_shown[i] != 0);
        packed.instances[i] = next;
        packed.instance_shown[i] = unit ? 1 : 0;
    }
    return changed;
}

bool uses(const PackedScene& packed, std::size_t instance, const std::vector<bool>& materials) {
    const MeshRange range = packed.meshes[packed.instance_meshes[instance]];
    for (std::uint32_t g = range.first_geometry; g < range.first_geometry + range.geometry_count; ++g) {
        if (materials[packed.geometries[g].material]) {
            return true;
        }
    }
    return false;
}

bool any(const std::vector<bool>& flags) {
    return std::find(flags.begin(), flags.end(), true) != flags.end();
}

void rename_if(bool changed, std::uint64_t& revision) {
    revision = changed ? new_revision() : revision;
}

bool same_lights(const std::vector<shared::PunctualLight>& a, const std::vector<shared::PunctualLight>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(shared::PunctualLight)) == 0);
}

}  // namespace

void pack_moment(const Scene& scene, const RenderSettings& settings, PackedScene& packed) {
    require_same(scene, scene.materials.size(), packed.materials.size(), "materials");
    require_same(scene, scene.lights.size(), packed.punctual_lights.size(), "lights");
    if (!packed.scene_instances.empty() && packed.scene_instances.back() >= scene.instances.size()) {
        require_same(scene, scene.instances.size(), packed.scene_instances.back() + 1U, "instances");
    }
    require_same_tint(scene, packed);
    keep_previous(packed);
    Revisions& revisions = packed.revisions;
    const std::vector<bool> materials = move_materials(scene, packed);
    rename_if(any(materials), revisions.materials);
    const std::vector<bool> instances = move_instances(scene, packed);
    rename_if(any(instances), revisions.instances);
    bool weigh = false;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (packed.instances[i].first_emitter_slot == shared::NONE) {
            continue;
        }
        const bool repainted = uses(packed, i, materials);
        if (instances[i] || repainted) {
            place_emitters(packed, i, repainted);
            weigh = true;
        }
    }
    const std::vector<shared::PunctualLight> before = packed.punctual_lights;
    place_punctual_lights(scene, packed);
    for (std::size_t i = 0; i < before.size(); ++i) {
        packed.punctual_lights[i].pmf = before[i].pmf;
        packed.punctual_lights[i].part = before[i].part;
    }
    const double environment_luminance = packed.environment_luminance;
    place_environment(scene, packed);
    weigh =
        weigh || environment_luminance != packed.environment_luminance || !same_lights(before, packed.punctual_lights);
    if (weigh) {
        weigh_lights(packed);
    }
    rename_if(weigh, revisions.emissive_triangles);
    rename_if(weigh, revisions.punctual_lights);
    rename_if(weigh, revisions.light_table);
    rename_if(weigh, revisions.light_clusters);
    rename_if(weigh, revisions.cluster_picks);
    rename_if(weigh, revisions.light_nodes);
    rename_if(weigh, revisions.light_places);
    rename_if(weigh, revisions.leaf_picks);
    pack_camera(scene, settings, packed);
}

void pack_view(const Scene& scene, const RenderSettings& settings, PackedScene& packed) {
    keep_previous(packed);
    pack_camera(scene, settings, packed);
}

}  // namespace diptych::core
