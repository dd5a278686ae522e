// Tables of the public scene and those of common's, field by field.
#include <algorithm>

#include <glm/glm.hpp>

#include "library/impl.h"

DIPTYCH_BEGIN

static Vec3 vec(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

static glm::vec3 vec(const Vec3& v) {
    return {v[0], v[1], v[2]};
}

static TextureSlot from_core(const core::TextureSlot& slot) {
    return {slot.texture, slot.uv_set, vec(slot.u_row), vec(slot.v_row)};
}

static core::TextureSlot to_core(const TextureSlot& slot) {
    return {slot.texture, slot.uv_set, vec(slot.u_row), vec(slot.v_row)};
}

static Material from_core(const core::Material& m) {
    return {.name = m.name,
            .base_color = {m.base_color.x, m.base_color.y, m.base_color.z, m.base_color.w},
            .metallic = m.metallic,
            .roughness = m.roughness,
            .normal_scale = m.normal_scale,
            .emission = vec(m.emission),
            .ior = m.ior,
            .specular = m.specular,
            .specular_color = vec(m.specular_color),
            .alpha_mode = static_cast<AlphaMode>(m.alpha_mode),
            .alpha_cutoff = m.alpha_cutoff,
            .double_sided = m.double_sided,
            .unlit = m.unlit,
            .base_color_texture = from_core(m.base_color_texture),
            .metallic_roughness_texture = from_core(m.metallic_roughness_texture),
            .normal_texture = from_core(m.normal_texture),
            .emission_texture = from_core(m.emission_texture),
            .specular_texture = from_core(m.specular_texture),
            .specular_color_texture = from_core(m.specular_color_texture)};
}

/// What the public material has not stays as it was: an animation of the emission.
static void write(const Material& m, core::Material& out) {
    out.name = m.name;
    out.base_color = {m.base_color[0], m.base_color[1], m.base_color[2], m.base_color[3]};
    out.metallic = m.metallic;
    out.roughness = m.roughness;
    out.normal_scale = m.normal_scale;
    out.emission = vec(m.emission);
    out.ior = m.ior;
    out.specular = m.specular;
    out.specular_color = vec(m.specular_color);
    out.alpha_mode = static_cast<core::AlphaMode>(m.alpha_mode);
    out.alpha_cutoff = m.alpha_cutoff;
    out.double_sided = m.double_sided;
    out.unlit = m.unlit;
    out.base_color_texture = to_core(m.base_color_texture);
    out.metallic_roughness_texture = to_core(m.metallic_roughness_texture);
    out.normal_texture = to_core(m.normal_texture);
    out.emission_texture = to_core(m.emission_texture);
    out.specular_texture = to_core(m.specular_texture);
    out.specular_color_texture = to_core(m.specular_color_texture);
}

static core::Environment to_core(const Environment& environment) {
    core::Environment out;
    const bool black = environment.scale == Vec3{0, 0, 0};
    out.scale = vec(environment.scale);
    out.rotation = environment.rotation;
    if (environment.map && !black) {
        out.kind = core::EnvironmentKind::map;
        out.width = environment.map->width;
        out.height = environment.map->height;
        out.texels.reserve(environment.map->texels.size());
        for (const Vec3& texel : environment.map->texels) {
            out.texels.push_back(vec(texel));
        }
    } else {
        out.kind = black ? core::EnvironmentKind::none : core::EnvironmentKind::constant;
    }
    return out;
}

glm::dmat4 to_core(const Matrix& matrix) {
    glm::dmat4 out;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            out[column][row] = matrix[static_cast<std::size_t>(4 * column + row)];
        }
    }
    return out;
}

Matrix from_core(const glm::dmat4& matrix) {
    Matrix out;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            out[static_cast<std::size_t>(4 * column + row)] = matrix[column][row];
        }
    }
    return out;
}

core::Camera to_core(const Camera& camera) {
    core::Camera out;
    out.name = camera.name;
    out.camera_to_world = to_core(camera.camera_to_world);
    out.orthographic = camera.orthographic;
    out.vertical_fov = camera.vertical_fov;
    out.orthographic_height = camera.orthographic_height;
    out.lens = {camera.lens_radius, camera.focus_distance};
    return out;
}

Camera from_core(const core::Camera& camera) {
    return {camera.name,
            from_core(camera.camera_to_world),
            camera.orthographic,
            camera.vertical_fov,
            camera.orthographic_height,
            camera.lens.radius,
            camera.lens.focus_distance,
            none};
}

core::PunctualLight to_core(const Light& light) {
    core::PunctualLight out;
    out.name = light.name;
    out.type = static_cast<core::PunctualType>(light.kind);
    out.light_to_world = to_core(light.light_to_world);
    out.intensity = vec(light.intensity);
    out.inner_cone = light.inner_cone;
    out.outer_cone = light.outer_cone;
    return out;
}

Light from_core(const core::PunctualLight& light) {
    return {light.name,
            static_cast<LightKind>(light.type),
            from_core(light.light_to_world),
            vec(light.intensity),
            light.inner_cone,
            light.outer_cone,
            none};
}

Environment from_core(const core::Environment& environment) {
    Environment out;
    if (environment.kind == core::EnvironmentKind::none) {
        return out;
    }
    out.scale = vec(environment.scale);
    out.rotation = environment.rotation;
    if (environment.kind == core::EnvironmentKind::map) {
        auto map = std::make_shared<EnvironmentMap>();
        map->width = environment.width;
        map->height = environment.height;
        map->texels.reserve(environment.texels.size());
        for (const glm::vec3& texel : environment.texels) {
            map->texels.push_back(vec(texel));
        }
        out.map = std::move(map);
    }
    return out;
}

static Instance from_core(const core::Instance& instance) {
    return {instance.name, instance.mesh, from_core(instance.object_to_world), none};
}

template <class Public, class Core>
static std::vector<Public> all_from(const std::vector<Core>& from) {
    std::vector<Public> all;
    all.reserve(from.size());
    for (const Core& one : from) {
        all.push_back(from_core(one));
    }
    return all;
}

Tables tables_of(const core::Scene& scene, const core::FileNodes& nodes) {
    Tables tables{all_from<Material>(scene.materials), all_from<Camera>(scene.cameras), all_from<Light>(scene.lights),
                  all_from<Instance>(scene.instances), from_core(scene.environment), {}};
    const auto hang = [](auto& table, int index, std::size_t node) {
        if (index != none) {
            table[static_cast<std::size_t>(index)].node = static_cast<int>(node);
        }
    };
    for (std::size_t i = 0; i < nodes.uses.size(); ++i) {
        hang(tables.instances, nodes.uses[i].instance, i);
        hang(tables.cameras, nodes.uses[i].camera, i);
        hang(tables.lights, nodes.uses[i].light, i);
    }
    return tables;
}

void apply(const Tables& before, const Tables& after, const core::FileNodes& nodes, core::Scene& scene) {
    const auto changed = [](const auto& a, const auto& b, std::size_t i) { return i >= a.size() || a[i] != b[i]; };
    // The scene itself knows only nodes that move: what hangs in others stands by its own matrix.
    const auto moving_node = [&](int node) {
        const core::NodeUse* use = node == none ? nullptr : &nodes.uses[static_cast<std::size_t>(node)];
        return use && use->moves ? use->scene_node : core::none;
    };
    for (std::size_t i = 0; i < after.nodes.size(); ++i) {
        const int at = nodes.uses[i].scene_node;
        if (at != core::none && changed(before.nodes, after.nodes, i)) {
            core::Node& node = scene.nodes[static_cast<std::size_t>(at)];
            const int parent = node.parent;  // an index into the scene's nodes, not the file's
            node = nodes.nodes[i];
            node.parent = parent;
        }
    }
    scene.materials.resize(after.materials.size());
    for (std::size_t i = 0; i < after.materials.size(); ++i) {
        if (changed(before.materials, after.materials, i)) {
            write(after.materials[i], scene.materials[i]);
        }
    }
    scene.cameras.resize(after.cameras.size());
    for (std::size_t i = 0; i < after.cameras.size(); ++i) {
        if (changed(before.cameras, after.cameras, i)) {
            core::Camera camera = to_core(after.cameras[i]);
            camera.aspect = scene.cameras[i].aspect;
            camera.node = moving_node(after.cameras[i].node);
            scene.cameras[i] = camera;
        }
    }
    scene.lights.resize(after.lights.size());
    for (std::size_t i = 0; i < after.lights.size(); ++i) {
        if (changed(before.lights, after.lights, i)) {
            core::PunctualLight light = to_core(after.lights[i]);
            light.node = moving_node(after.lights[i].node);
            light.moving_color = scene.lights[i].moving_color;
            scene.lights[i] = light;
        }
    }
    scene.instances.resize(after.instances.size());
    for (std::size_t i = 0; i < after.instances.size(); ++i) {
        if (changed(before.instances, after.instances, i)) {
            const Instance& instance = after.instances[i];
            scene.instances[i] = {instance.name, instance.mesh, to_core(instance.object_to_world),
                                  moving_node(instance.node)};
        }
    }
    if (before.environment != after.environment) {
        scene.environment = to_core(after.environment);
    }
}

DIPTYCH_END
