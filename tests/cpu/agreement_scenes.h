// Small scenes that stress how light is found: each must come out the same whatever the strategy.
#pragma once

#include <utility>
#include <vector>

#include "render_fixture.h"

namespace diptych::core::tests {

/// Checks, opaque and bright beside nearly clear and dark: `size` texels a side.
inline int add_checker_texture(Scene& scene, int size, Filter filter) {
    TextureImage image;
    image.name = "checker";
    image.width = size;
    image.height = size;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const bool on = (x + y) % 2 == 0;
            image.rgba.insert(image.rgba.end(),
                              {static_cast<std::uint8_t>(on ? 255 : 20), static_cast<std::uint8_t>(on ? 200 : 40),
                               static_cast<std::uint8_t>(on ? 120 : 200), static_cast<std::uint8_t>(on ? 255 : 60)});
        }
    }
    scene.images.push_back(std::move(image));
    Texture texture;
    texture.image = static_cast<int>(scene.images.size()) - 1;
    texture.filter = filter;
    scene.textures.push_back(texture);
    return static_cast<int>(scene.textures.size()) - 1;
}

/// A room corner: floor, back wall, a glossy block. `panel` is the material of a square light over it, with texture
/// coordinates.
inline Scene corner_scene(Material panel, bool textured) {
    Scene scene;
    scene.name = "corner";
    const int floor = add_material(scene, diffuse_material(0.6F));
    const int wall = add_material(scene, make_material("wall", {0.7F, 0.3F, 0.2F}, 0, 0.6F));
    const int metal = add_material(scene, make_material("metal", {0.9F, 0.8F, 0.6F}, 1, 0.4F));
    if (textured) {
        const int texture = add_checker_texture(scene, 4, Filter::linear);
        panel.emission_texture.texture = texture;
        panel.base_color_texture.texture = panel.alpha_mode == AlphaMode::opaque ? none : texture;
    }
    const int light = add_material(scene, std::move(panel));
    add_object(scene, "floor", {horizontal_square(glm::vec3(0), 2, true, floor)});
    Primitive back;
    back.material = wall;
    add_quad(back, {-2, 0, -2}, {2, 0, -2}, {2, 3, -2}, {-2, 3, -2});
    add_object(scene, "wall", {back});
    Primitive block;
    block.material = metal;
    add_box(block, {-0.3F, 0, -0.3F}, {0.3F, 0.6F, 0.3F});
    add_object(scene, "block", {block}, translation(-0.5, 0, -0.5));
    Primitive square = horizontal_square(glm::vec3(0), 0.5F, false, light);
    square.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    add_object(scene, "light", {square}, translation(0.2, 1.6, -0.4));
    scene.cameras.push_back(make_camera("camera", {0.5, 1, 3.2}, {0, 0.8, -0.5}, 45));
    return scene;
}

/// Pairs of a name and a scene.
inline std::vector<std::pair<std::string, Scene>> agreement_scenes() {
    std::vector<std::pair<std::string, Scene>> out;
    const Material bright = make_emitter("panel", {4, 4, 4});
    out.emplace_back("textured emission", corner_scene(bright, true));

    Material mask = bright;
    mask.alpha_mode = AlphaMode::mask;
    mask.base_color = {0.3F, 0.3F, 0.3F, 1};
    out.emplace_back("emitter cut out by MASK", corner_scene(mask, true));
    Material blend = bright;
    blend.alpha_mode = AlphaMode::blend;
    blend.double_sided = true;
    out.emplace_back("two-sided emitter under BLEND", corner_scene(blend, true));

    Scene mirrored = corner_scene(bright, true);
    glm::dmat4 flip = translation(0.2, 1.6, -0.4);
    // Handedness swapped: the light still shines down, as its front turns with the winding.
    flip[0] = {-1.5, 0.2, 0, 0};
    mirrored.instances.back().object_to_world = flip;
    mirrored.instances.push_back(mirrored.instances.back());
    mirrored.instances.back().object_to_world = translation(-0.9, 0.4, 0.3);
    mirrored.instances.back().object_to_world[2] = {0, 0.2, -0.4, 0};
    mirrored.instances.back().object_to_world[1] = {0, 1, 0, 0};
    out.emplace_back("mirrored instances of a light", mirrored);

    Scene lens = corner_scene(bright, false);
    lens.cameras[0].lens.radius = 0.15;
    lens.cameras[0].lens.focus_distance = 3;
    out.emplace_back("thin lens", lens);

    Scene sky = corner_scene(bright, false);
    sky.environment = sunny_sky(32, 16, 60);
    sky.environment.rotation = 0.7;
    out.emplace_back("environment map with a sun", sky);

    Scene behind = corner_scene(bright, false);
    behind.cameras = {make_camera("from above", {0.5, 3, 2}, {0, 1, -0.4}, 45)};
    out.emplace_back("one-sided emitter from behind", behind);

    Scene bumpy = corner_scene(bright, false);
    TextureImage map;
    map.name = "bumps";
    map.width = 2;
    map.height = 2;
    map.rgba = {200, 128, 220, 255, 128, 60, 220, 255, 90, 170, 230, 255, 128, 128, 255, 255};
    bumpy.images.push_back(map);
    Texture texture;
    texture.image = 0;
    bumpy.textures.push_back(texture);
    bumpy.materials[0].normal_texture.texture = 0;
    bumpy.materials[0].roughness = 0.4F;
    bumpy.materials[0].specular = 1;
    Primitive& floor = bumpy.meshes[0].primitives[0];
    floor.uvs[0] = {{0, 0}, {3, 0}, {3, 3}, {0, 3}};
    floor.tangents.assign(4, glm::vec4(1, 0, 0, 1));
    out.emplace_back("normal-mapped gloss", bumpy);

    Scene mirror = corner_scene(bright, false);
    mirror.materials[2].roughness = 0;
    mirror.materials[1].roughness = 0;  // a mirror coat over a diffuse wall
    out.emplace_back("mirrors", mirror);

    Scene unlit = corner_scene(bright, false);
    unlit.materials[3] = make_material("screen", {2, 1, 0.5F}, 0, 1);
    unlit.materials[3].unlit = true;
    PunctualLight spot;
    spot.type = PunctualType::spot;
    spot.intensity = {3, 3, 6};
    spot.light_to_world = make_camera("", {1, 2.5, 1}, {-0.5, 0, -0.5}, 45).camera_to_world;
    unlit.lights.push_back(spot);
    out.emplace_back("unlit screen and a spot light", unlit);
    return out;
}

}  // namespace diptych::core::tests
