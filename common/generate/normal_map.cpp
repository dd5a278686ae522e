// One brick relief as a normal map, seen head-on on a wall and at a grazing angle on a floor.
#include "generate/scenes.h"
#include "generate/shapes.h"

#include <algorithm>
#include <cmath>

namespace diptych::core {
namespace {

constexpr int map_size = 256;
constexpr int rows = 8, columns = 4;  // bricks; rows even, as every other one is shifted by half

struct Brick {
    double height;  // 0 in the joint, 1 on the brick
    int row, column;
};

/// The relief at texel coordinates, which wrap around.
Brick brick_at(double x, double y) {
    const double v = y / map_size * rows;
    const int row = int(std::floor(v)) & (rows - 1);
    const double u = x / map_size * columns + (row % 2 == 0 ? 0.0 : 0.5);
    const int column = int(std::floor(u)) & (columns - 1);
    // Distances to the brick's edges, in texels; the joint is 3 texels deep in each brick, the slope 5.
    const double to_u = std::min(u - std::floor(u), std::floor(u) + 1 - u) * map_size / columns;
    const double to_v = std::min(v - std::floor(v), std::floor(v) + 1 - v) * map_size / rows;
    const double t = std::clamp((std::min(to_u, to_v) - 1.5) / 5, 0.0, 1.0);
    return {t * t * (3 - 2 * t), row, column};
}

TextureImage blank_image(const char* name) {
    TextureImage out;
    out.name = name;
    out.width = out.height = map_size;
    out.rgba.resize(std::size_t(4) * map_size * map_size, 255);
    return out;
}

std::uint8_t to_byte(double value) {
    return std::uint8_t(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

TextureImage normal_image() {
    TextureImage out = blank_image("normal");
    constexpr double depth = 3;  // texels
    for (int y = 0; y < map_size; ++y) {
        for (int x = 0; x < map_size; ++x) {
            const double u = x + 0.5, v = y + 0.5;
            const double slope_right = depth * (brick_at(u + 1, v).height - brick_at(u - 1, v).height) / 2;
            const double slope_up = depth * (brick_at(u, v - 1).height - brick_at(u, v + 1).height) / 2;
            const glm::dvec3 n = glm::normalize(glm::dvec3(-slope_right, -slope_up, 1));
            for (int c = 0; c < 3; ++c) {
                out.rgba[std::size_t(4 * (y * map_size + x) + c)] = to_byte(0.5 + 0.5 * n[c]);
            }
        }
    }
    return out;
}

TextureImage color_image() {
    TextureImage out = blank_image("color");
    const glm::dvec3 joint(0.72, 0.70, 0.66);  // sRGB
    for (int y = 0; y < map_size; ++y) {
        for (int x = 0; x < map_size; ++x) {
            const Brick brick = brick_at(x + 0.5, y + 0.5);
            const double shade = 0.8 + 0.05 * ((brick.row * 5 + brick.column * 3) % 7);
            const glm::dvec3 color = glm::mix(joint, shade * glm::dvec3(0.62, 0.34, 0.27), brick.height);
            for (int c = 0; c < 3; ++c) {
                out.rgba[std::size_t(4 * (y * map_size + x) + c)] = to_byte(color[c]);
            }
        }
    }
    return out;
}

/// A quad with texture coordinates over [0, 1]², u from a to b, the image's top along d c.
Primitive mapped_quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d, int material) {
    Primitive out;
    out.material = material;
    add_quad(out, a, b, c, d);
    out.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    out.normals.assign(4, glm::normalize(glm::cross(b - a, d - a)));
    out.tangents.assign(4, glm::vec4(glm::normalize(b - a), 1));
    return out;
}

int add_bricks(Scene& scene, const char* name, float metallic, float roughness, const glm::vec2& repeat) {
    Material out = make_material(name, glm::vec3(1), metallic, roughness);
    for (TextureSlot* slot : {&out.base_color_texture, &out.normal_texture}) {
        slot->u_row.x = repeat.x;
        slot->v_row.y = repeat.y;
    }
    out.normal_texture.texture = 0;
    out.base_color_texture.texture = 1;
    return add_material(scene, out);
}

}  // namespace

GeneratedScene generate_normal_map(const GenerateOptions&) {
    GeneratedScene out;
    Scene& scene = out.scene;
    scene.name = "normal-map";
    scene.images = {normal_image(), color_image()};
    for (int i = 0; i < 2; ++i) {
        Texture texture;
        texture.name = scene.images[std::size_t(i)].name;
        texture.image = i;
        scene.textures.push_back(texture);
    }
    const int wall = add_bricks(scene, "wall", 0, 0.6F, {2, 1});
    const int floor = add_bricks(scene, "floor", 0, 0.25F, {4, 6});
    add_object(scene, "head-on", {mapped_quad({-2, 0, -4}, {2, 0, -4}, {2, 2, -4}, {-2, 2, -4}, wall)});
    add_object(scene, "grazing", {mapped_quad({-4, 0, 6}, {4, 0, 6}, {4, 0, -6}, {-4, 0, -6}, floor)});

    Primitive lamp;
    lamp.material = add_material(scene, make_emitter("lamp", {30, 28, 25}));
    add_quad(lamp, {-2.5F, 3.2F, -1.6F}, {-2.5F, 3.2F, -2.4F}, {-1.7F, 3.6F, -2.4F}, {-1.7F, 3.6F, -1.6F});
    add_object(scene, "lamp", {lamp});
    Primitive fill;
    fill.material = add_material(scene, make_emitter("fill", {1.2F, 1.3F, 1.5F}));
    add_quad(fill, {-1.5F, 3.5F, 3}, {-1.5F, 3, 2}, {1.5F, 3, 2}, {1.5F, 3.5F, 3});
    add_object(scene, "fill", {fill});
    const int bulb = add_material(scene, make_emitter("bulb", {60, 100, 200}));
    add_object(scene, "bulb", {make_sphere(0.05F, 32, 16, bulb)}, translation(1.4, 0.5, -2.2));

    scene.cameras.push_back(make_camera("camera", {0, 0.8, 1.6}, {0, 0.8, -4}, 40));
    scene.cameras.push_back(make_camera("grazing", {0, 0.15, 1.6}, {0, 0.05, -4}, 30));
    return out;
}

}  // namespace diptych::core
