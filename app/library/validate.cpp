// What an edit may say. Files are checked where they are read.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <numbers>

#include "library/impl.h"
#include "settings/ranges.h"

DIPTYCH_BEGIN

std::string object(const char* table, std::size_t index, const std::string& name) {
    return fmt::format("{}[{}]{}", table, index, name.empty() ? "" : " '" + name + "'");
}

namespace {

void require(bool holds, const std::string& object, const char* field, double value, const char* range) {
    if (!holds) {
        throw Error(fmt::format("{}: {} is {:g}; it has to be {}", object, field, value, range));
    }
}

template <class Values>
void require_finite(const Values& values, const std::string& object, const char* field) {
    for (const auto value : values) {
        require(std::isfinite(value), object, field, value, "finite");
    }
}

template <class Values>
void require_not_negative(const Values& values, const std::string& object, const char* field) {
    for (const auto value : values) {
        require(std::isfinite(value) && value >= 0, object, field, value, "finite and not negative");
    }
}

void require_share(float value, const std::string& object, const char* field) {
    require(value >= 0 && value <= 1, object, field, value, "between 0 and 1");
}

void check_slot(const TextureSlot& slot, const std::string& object, const char* field, std::size_t textures) {
    const bool exists =
        slot.texture == none || (slot.texture >= 0 && static_cast<std::size_t>(slot.texture) < textures);
    require(exists, object, field, slot.texture, fmt::format("below the number of textures, {}", textures).c_str());
    require(slot.uv_set == 0 || slot.uv_set == 1, object, "uv_set", slot.uv_set, "0 or 1");
}

void check(const Material& m, const std::string& object, std::size_t textures) {
    require_not_negative(m.base_color, object, "base_color");
    require_share(m.metallic, object, "metallic");
    require_share(m.roughness, object, "roughness");
    require(std::isfinite(m.normal_scale), object, "normal_scale", m.normal_scale, "finite");
    require_not_negative(m.emission, object, "emission");
    require(m.ior == 0 || (std::isfinite(m.ior) && m.ior >= 1), object, "ior", m.ior, "0, or finite and at least 1");
    require_share(m.specular, object, "specular");
    require_not_negative(m.specular_color, object, "specular_color");
    require(std::isfinite(m.alpha_cutoff) && m.alpha_cutoff >= 0, object, "alpha_cutoff", m.alpha_cutoff,
            "finite and not negative");
    check_slot(m.base_color_texture, object, "base_color_texture", textures);
    check_slot(m.metallic_roughness_texture, object, "metallic_roughness_texture", textures);
    check_slot(m.normal_texture, object, "normal_texture", textures);
    check_slot(m.emission_texture, object, "emission_texture", textures);
    check_slot(m.specular_texture, object, "specular_texture", textures);
    check_slot(m.specular_color_texture, object, "specular_color_texture", textures);
}

/// Whether the upper 3 x 3 part has orthogonal columns of length 1.
bool is_rigid(const Matrix& m) {
    for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = 0; b <= a; ++b) {
            const double dot = m[4 * a] * m[4 * b] + m[4 * a + 1] * m[4 * b + 1] + m[4 * a + 2] * m[4 * b + 2];
            if (!(std::abs(dot - (a == b ? 1 : 0)) < 1e-4)) {
                return false;
            }
        }
    }
    return true;
}

void check_camera(const Camera& c, const std::string& object) {
    require_finite(c.camera_to_world, object, "camera_to_world");
    if (!is_rigid(c.camera_to_world)) {
        throw Error(object + ": camera_to_world has to be rigid: a rotation and a translation");
    }
    if (c.orthographic) {
        require(std::isfinite(c.orthographic_height) && c.orthographic_height > 0, object, "orthographic_height",
                c.orthographic_height, "finite and positive");
    } else {
        require(c.vertical_fov > 0 && c.vertical_fov < std::numbers::pi, object, "vertical_fov", c.vertical_fov,
                "between 0 and pi");
    }
    require(std::isfinite(c.lens_radius) && c.lens_radius >= 0, object, "lens_radius", c.lens_radius,
            "finite and not negative");
    require(std::isfinite(c.focus_distance) && c.focus_distance > 0, object, "focus_distance", c.focus_distance,
            "finite and positive");
}

void check(const Light& light, const std::string& object) {
    require_finite(light.light_to_world, object, "light_to_world");
    require_not_negative(light.intensity, object, "intensity");
    if (light.kind == LightKind::spot) {
        require(light.outer_cone > 0 && light.outer_cone <= std::numbers::pi / 2 + 1e-9, object, "outer_cone",
                light.outer_cone, "above 0 and at most pi/2");
        require(light.inner_cone >= 0 && light.inner_cone < light.outer_cone, object, "inner_cone", light.inner_cone,
                "at least 0 and below outer_cone");
    }
}

void check(const Environment& environment) {
    require_not_negative(environment.scale, "environment", "scale");
    require(std::isfinite(environment.rotation), "environment", "rotation", environment.rotation, "finite");
    if (environment.map) {
        const EnvironmentMap& map = *environment.map;
        if (map.width <= 0 || map.height <= 0 ||
            map.texels.size() != static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height)) {
            throw Error(fmt::format("environment: the map has {} texels; its size is {}x{}", map.texels.size(),
                                    map.width, map.height));
        }
        for (const Vec3& texel : map.texels) {
            require_not_negative(texel, "environment", "a texel");
        }
    }
}

/// Nodes are those of the file: only their names and matrices may change.
void check_nodes(const std::vector<Node>& nodes, const std::vector<Node>& synced) {
    if (nodes.size() != synced.size()) {
        throw Error(fmt::format("nodes: there are {}; they have to stay the file's {}", nodes.size(), synced.size()));
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Node& node = nodes[i];
        const std::string name = object("nodes", i, node.name);
        if (node.parent != synced[i].parent || node.children != synced[i].children ||
            node.animated != synced[i].animated) {
            throw Error(name + ": parent, children and animated are the file's, and cannot be edited");
        }
        const Matrix& m = node.node_to_parent;
        require_finite(m, name, "node_to_parent");
        if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
            throw Error(name + ": node_to_parent has to be affine: its last row is 0 0 0 1");
        }
    }
}

void require_node(int node, const std::string& object, std::size_t nodes) {
    const bool exists = node == none || (node >= 0 && static_cast<std::size_t>(node) < nodes);
    require(exists, object, "node", node, fmt::format("-1, or below the number of nodes, {}", nodes).c_str());
}

void require_not_fewer(std::size_t now, std::size_t loaded, const char* table) {
    if (now < loaded) {
        throw Error(fmt::format("{}: {} of the scene's {} are gone; other parts of the scene refer to them by index",
                                table, loaded - now, loaded));
    }
}

}  // namespace

void check(const Tables& tables, const Tables& synced, const core::Scene& scene, std::size_t nodes) {
    check_nodes(tables.nodes, synced.nodes);
    require_not_fewer(tables.materials.size(), scene.materials.size(), "materials");
    if (!scene.animations.empty()) {
        require_not_fewer(tables.lights.size(), scene.lights.size(), "lights");
    }
    for (std::size_t i = 0; i < tables.materials.size(); ++i) {
        check(tables.materials[i], object("materials", i, tables.materials[i].name), scene.textures.size());
    }
    for (std::size_t i = 0; i < tables.cameras.size(); ++i) {
        const std::string name = object("cameras", i, tables.cameras[i].name);
        check_camera(tables.cameras[i], name);
        require_node(tables.cameras[i].node, name, nodes);
    }
    for (std::size_t i = 0; i < tables.lights.size(); ++i) {
        const std::string name = object("lights", i, tables.lights[i].name);
        check(tables.lights[i], name);
        require_node(tables.lights[i].node, name, nodes);
    }
    for (std::size_t i = 0; i < tables.instances.size(); ++i) {
        const Instance& instance = tables.instances[i];
        const std::string name = object("instances", i, instance.name);
        const bool exists = instance.mesh >= 0 && static_cast<std::size_t>(instance.mesh) < scene.meshes.size();
        require(exists, name, "mesh", instance.mesh,
                fmt::format("an index below the number of meshes, {}", scene.meshes.size()).c_str());
        require_finite(instance.object_to_world, name, "object_to_world");
        require_node(instance.node, name, nodes);
    }
    check(tables.environment);
}

void check(const Camera& camera) {
    check_camera(camera, camera.name.empty() ? "camera" : "camera '" + camera.name + "'");
}

void check(const Settings& s, std::size_t cameras) {
    constexpr int largest_side = 65536;
    for (const int side : s.size) {
        if (side < 1 || side > largest_side) {
            throw SettingError(
                fmt::format("settings: size is {}; a side has to be 1 to {} pixels", side, largest_side));
        }
    }
    if (s.camera < 0 || static_cast<std::size_t>(s.camera) >= cameras) {
        throw SettingError(fmt::format("settings: camera is {}; the scene has {}, counted from 0", s.camera, cameras));
    }
    namespace ranges = core::ranges;
    const auto in_range = [](const core::SettingRange& range, double value, const char* field) {
        if (!range.accepted.holds(value)) {
            throw SettingError(fmt::format("settings: {} is {:g}; it has to lie between {:g} and {:g}", field, value,
                                           range.accepted.least, range.accepted.most));
        }
    };
    in_range(ranges::max_depth, s.max_depth, "max_depth");
    const ResamplingSettings& r = s.resampling;
    in_range(ranges::candidates, r.light_candidates, "resampling.light_candidates");
    in_range(ranges::near_share, static_cast<double>(r.near_share), "resampling.near_share");
    in_range(ranges::spatial_passes, r.spatial_passes, "resampling.spatial_passes");
    in_range(ranges::neighbors, r.neighbors, "resampling.neighbors");
    in_range(ranges::reuse_radius, static_cast<double>(r.radius), "resampling.radius");
    in_range(ranges::confidence_cap, static_cast<double>(r.confidence_cap), "resampling.confidence_cap");
}

void check(const BackendChoice& choice) {
    const bool vulkan = choice.backend == Backend::vulkan;
    if (!vulkan && (!choice.device.empty() || choice.validation)) {
        throw SettingError("backend " + name_of(choice.backend) + ": device and validation are vulkan's");
    }
    if (vulkan && choice.threads != 0) {
        throw SettingError("backend vulkan: threads are those of cpu and oracle");
    }
    if (choice.threads < 0) {
        throw SettingError(fmt::format("backend: threads is {}; 0 is one a core", choice.threads));
    }
}

DIPTYCH_END
