#include "random_scene/shrink.h"

#include <algorithm>

namespace diptych::core {

namespace {

/// Drops one part; false where there is nothing to drop.
using Drop = std::function<bool(RandomScene&)>;

template <typename T>
bool set(T& value, const T& plain) {
    if (value == plain) {
        return false;
    }
    value = plain;
    return true;
}

template <typename T>
bool clear(T& list) {
    const bool had = !list.empty();
    list.clear();
    return had;
}

bool clear_slot(TextureSlot& slot) {
    const bool had = slot.texture != none;
    slot = {};
    return had;
}

bool drop_transform(TextureSlot& slot) {
    const bool had = set(slot.u_row, {1, 0, 0});
    return set(slot.v_row, {0, 1, 0}) || had;
}

bool drop_emission(Material& material) {
    material.moving_emission.reset();
    return set(material.emission, glm::vec3(0));
}

template <typename Part>
bool erase(std::vector<Part>& parts, std::size_t i) {
    if (i >= parts.size()) {
        return false;
    }
    parts.erase(parts.begin() + std::ptrdiff_t(i));
    return true;
}

bool drop_light(Scene& scene, std::size_t i) {
    const auto of_light = [](const Channel& c) { return c.property == AnimatedProperty::light_intensity; };
    for (Animation& animation : scene.animations) {
        std::erase_if(animation.channels, [&](const Channel& c) { return of_light(c) && c.target == int(i); });
        for (Channel& channel : animation.channels) {
            channel.target -= of_light(channel) && channel.target > int(i) ? 1 : 0;
        }
    }
    return erase(scene.lights, i);
}

bool moves_node(const Channel& channel) {
    return channel.property == AnimatedProperty::translation || channel.property == AnimatedProperty::rotation ||
           channel.property == AnimatedProperty::scale;
}

/// From the last part, so that the places of those before stay.
void add_part_drops(std::vector<Drop>& drops) {
    drops.emplace_back([](RandomScene& r) { return clear(r.scene.animations); });
    for (std::size_t i = 16; i-- > 0;) {
        for (const std::size_t clip : {0U, 1U}) {
            drops.emplace_back([clip, i](RandomScene& r) {
                return clip < r.scene.animations.size() && erase(r.scene.animations[clip].channels, i);
            });
        }
    }
    for (std::size_t i = 8; i-- > 0;) {
        drops.emplace_back([i](RandomScene& r) { return drop_light(r.scene, i); });
    }
    for (std::size_t i = 8; i-- > 0;) {
        drops.emplace_back([i](RandomScene& r) { return erase(r.scene.instances, i); });
    }
}

void add_material_drops(std::vector<Drop>& drops, std::size_t i) {
    const auto add = [&](auto drop) {
        drops.push_back([i, drop](RandomScene& r) { return i < r.scene.materials.size() && drop(r.scene.materials[i]); });
    };
    for (TextureSlot Material::*const slot : texture_slots) {
        add([slot](Material& m) { return clear_slot(m.*slot); });
        add([slot](Material& m) { return drop_transform(m.*slot); });
        add([slot](Material& m) { return set((m.*slot).uv_set, 0); });
    }
    add([](Material& m) { return drop_emission(m); });
    add([](Material& m) { return set(m.alpha_mode, AlphaMode::opaque); });
    add([](Material& m) { return set(m.metallic, 0.0F); });
    add([](Material& m) { return set(m.roughness, 1.0F); });
    add([](Material& m) { return set(m.specular, 1.0F); });
    add([](Material& m) { return set(m.specular_color, glm::vec3(1)); });
    add([](Material& m) { return set(m.ior, 1.5F); });
    add([](Material& m) { return set(m.normal_scale, 1.0F); });
    add([](Material& m) { return set(m.unlit, false); });
    add([](Material& m) { return set(m.double_sided, false); });
    add([](Material& m) { return set(m.base_color, glm::vec4(0.8F, 0.8F, 0.8F, 1)); });
}

void add_primitive_drops(std::vector<Drop>& drops) {
    const auto add = [&](auto drop) {
        drops.push_back([drop](RandomScene& r) {
            bool any = false;
            for (Mesh& mesh : r.scene.meshes) {
                for (Primitive& primitive : mesh.primitives) {
                    any = drop(primitive) || any;
                }
            }
            return any;
        });
    };
    add([](Primitive& p) { return clear(p.tangents); });
    add([](Primitive& p) { return clear(p.colors); });
    add([](Primitive& p) { return clear(p.normals); });
    add([](Primitive& p) { return clear(p.uvs[1]); });
    add([](Primitive& p) { return clear(p.uvs[0]); });
}

std::vector<Drop> all_drops() {
    std::vector<Drop> drops;
    add_part_drops(drops);
    drops.emplace_back([](RandomScene& r) { return set(r.scene.environment.kind, EnvironmentKind::none); });
    drops.emplace_back([](RandomScene& r) { return set(r.settings.max_depth, 1U); });
    drops.emplace_back([](RandomScene& r) {
        return set(r.scene.cameras[std::size_t(r.settings.camera)].lens.radius, 0.0);
    });
    drops.emplace_back([](RandomScene& r) { return drop_nodes(r.scene); });
    add_primitive_drops(drops);
    for (std::size_t i = 0; i < 12; ++i) {
        add_material_drops(drops, i);
    }
    drops.emplace_back([](RandomScene& r) { return set(r.settings.brdf, BrdfModel::ggx); });
    drops.emplace_back([](RandomScene& r) { return set(r.settings.normal_maps, NormalMaps::shading); });
    drops.emplace_back([](RandomScene& r) { return set(r.settings.light_sampler, LightSampler::power); });
    return drops;
}

/// Parts that nothing shows any more: meshes keep their places, since instances name them.
bool shows_something(const RandomScene& random) {
    return !random.scene.instances.empty();
}

}  // namespace

bool drop_nodes(Scene& scene) {
    for (const Animation& animation : scene.animations) {
        if (std::any_of(animation.channels.begin(), animation.channels.end(), moves_node)) {
            return false;
        }
    }
    for (Instance& instance : scene.instances) {
        instance.node = none;
    }
    for (PunctualLight& light : scene.lights) {
        light.node = none;
    }
    for (Camera& camera : scene.cameras) {
        camera.node = none;
    }
    return clear(scene.nodes);
}

RandomScene shrink(RandomScene failing, const StillFails& still_fails, int most_trials) {
    const std::vector<Drop> drops = all_drops();
    int trials = 0;
    for (bool smaller = true; smaller;) {
        smaller = false;
        for (const Drop& drop : drops) {
            RandomScene candidate = failing;
            if (trials == most_trials || !drop(candidate) || !shows_something(candidate)) {
                continue;
            }
            ++trials;
            if (still_fails(candidate)) {
                failing = std::move(candidate);
                smaller = true;
            }
        }
    }
    return failing;
}

}  // namespace diptych::core
