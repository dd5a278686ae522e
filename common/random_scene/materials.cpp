#include <algorithm>

#include "random_scene/parts.h"
#include "generate/shapes.h"

namespace diptych::core {

namespace {

/// All four channels of all texels differ.
TextureImage random_image(Draws& draws, const std::string& name, const glm::ivec2 ranges[4]) {
    TextureImage image;
    image.name = name;
    image.width = 2 + draws.below(4);
    image.height = 2 + draws.below(4);
    for (int texel = 0; texel < image.width * image.height; ++texel) {
        for (int c = 0; c < 4; ++c) {
            image.rgba.push_back(std::uint8_t(ranges[c].x + draws.below(ranges[c].y - ranges[c].x + 1)));
        }
    }
    return image;
}

int add_texture(Scene& scene, Draws& draws, TextureImage image) {
    Texture texture;
    texture.name = image.name;
    texture.image = int(scene.images.size());
    texture.wrap_u = draws.pick({Wrap::repeat, Wrap::clamp, Wrap::mirror});
    texture.wrap_v = draws.pick({Wrap::repeat, Wrap::clamp, Wrap::mirror});
    texture.filter = draws.pick({Filter::nearest, Filter::linear});
    scene.images.push_back(std::move(image));
    scene.textures.push_back(texture);
    return int(scene.textures.size()) - 1;
}

/// One channel is 0 and another nearly 1: what goes by one channel alone goes wrong.
glm::vec3 strong_color(Draws& draws) {
    glm::vec3 color(draws.within(0.15, 0.6));
    const int dark = draws.below(3);
    const int bright = (dark + 1 + draws.below(2)) % 3;
    color[dark] = 0;
    color[bright] = 0.9F;
    return color;
}

glm::vec3 random_color(Draws& draws) {
    return draws.chance(0.3) ? strong_color(draws) : glm::vec3(draws.within(0.15, 1));
}

TextureSlot random_slot(Draws& draws, const std::vector<int>& textures, double probability) {
    TextureSlot slot;
    if (!draws.chance(probability)) {
        return slot;
    }
    slot.texture = textures[std::size_t(draws.below(int(textures.size())))];
    slot.uv_set = draws.below(2);
    if (draws.chance(0.5)) {  // KHR_texture_transform: offset + R·S·(u, v)
        const double c = draws.between(-1, 1);
        const double s = draws.sign() * std::sqrt(1 - c * c);
        const glm::dvec2 scale{draws.between(0.4, 1.6), draws.sign() * draws.between(0.4, 1.6)};
        const glm::dvec2 offset{draws.between(-1, 1), draws.between(-1, 1)};
        slot.u_row = glm::vec3(c * scale.x, s * scale.y, offset.x);
        slot.v_row = glm::vec3(-s * scale.x, c * scale.y, offset.y);
    }
    return slot;
}

void draw_emission(Material& material, Draws& draws, double most) {
    MovingEmission emission;
    emission.factor = glm::vec3(draws.within(0.2, 1));
    emission.strength = float(draws.between(0.3, most));
    material.emission = emission.factor * emission.strength;
    material.moving_emission = emission;  // so that the file has the strength apart, whatever the factor is
}

/// Narrow lobes meet small lights rarely, so nothing is between a perfect mirror and roughness 0.45.
float random_roughness(Draws& draws) {
    const double kind = draws.between(0, 1);
    return kind < 0.08 ? 0.0F : kind < 0.3 ? 1.0F : float(draws.between(0.45, 1));
}

void draw_specular(Material& material, Draws& draws) {
    if (draws.chance(0.5)) {
        material.ior = draws.pick({1.0F, 1.8F, 2.4F, 0.0F});
    }
    if (draws.chance(0.4)) {
        material.specular = draws.chance(0.2) ? 0.0F : float(draws.between(0, 1));
        material.specular_color = glm::vec3(draws.within(0, 1.5));
    }
}

void draw_alpha(Material& material, Draws& draws) {
    const double kind = draws.between(0, 1);
    material.alpha_mode = kind < 0.6 ? AlphaMode::opaque : kind < 0.8 ? AlphaMode::mask : AlphaMode::blend;
    material.base_color.a = float(draws.between(0.5, 1));
    material.alpha_cutoff = float(draws.between(0.2, 0.6));
}

}  // namespace

TexturePool add_textures(Scene& scene, Draws draws) {
    // The channels' means differ, so that one taken for another shows. Green is roughness, which is to stay high; alpha
    // is coverage, or the specular factor. Normals lean to one side, so that what is done to them does not cancel.
    constexpr glm::ivec2 value_ranges[4] = {{15, 140}, {170, 255}, {0, 255}, {130, 255}};
    constexpr glm::ivec2 normal_ranges[4] = {{110, 215}, {40, 140}, {170, 255}, {0, 255}};
    TexturePool pool;
    for (int i = 0; i < 5; ++i) {
        const std::string number = std::to_string(i);
        pool.values.push_back(add_texture(scene, draws, random_image(draws, "value" + number, value_ranges)));
    }
    for (int i = 0; i < 2; ++i) {
        const std::string number = std::to_string(i);
        pool.normals.push_back(add_texture(scene, draws, random_image(draws, "normal" + number, normal_ranges)));
    }
    return pool;
}

int add_random_material(Scene& scene, const TexturePool& textures, Role role, Draws draws) {
    Material material;
    material.name = "material" + std::to_string(scene.materials.size());
    material.base_color = glm::vec4(random_color(draws), 1);
    material.metallic = draws.pick({0.0F, 0.0F, 1.0F, float(0.7)});
    material.roughness = random_roughness(draws);
    draw_specular(material, draws);
    draw_alpha(material, draws);
    material.double_sided = draws.chance(0.5);
    material.unlit = draws.chance(0.04);
    const bool emits = draws.chance(0.3);
    if (emits || role == Role::lamp) {
        draw_emission(material, draws, role == Role::lamp ? 5 : 2);
    }
    material.base_color_texture = random_slot(draws, textures.values, 0.5);
    material.metallic_roughness_texture = random_slot(draws, textures.values, 0.4);
    material.emission_texture = random_slot(draws, textures.values, 0.5);
    material.specular_texture = random_slot(draws, textures.values, 0.4);
    material.specular_color_texture = random_slot(draws, textures.values, 0.3);
    material.normal_texture = random_slot(draws, textures.normals, 0.45);
    material.normal_scale = draws.pick({1.0F, 0.4F, 2.0F, -1.5F});
    if (role == Role::room) {
        material = make_material("room", strong_color(draws), 0, 1);
        material.specular = draws.chance(0.7) ? 0.0F : 1.0F;
        material.double_sided = true;
        material.emission = glm::vec3(draws.within(0.02, 0.4));
    }
    return add_material(scene, std::move(material));
}

}  // namespace diptych::core
