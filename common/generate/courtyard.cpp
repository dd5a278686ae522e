// A columned hall around an open court, lit by nothing but the sky: bright stone, and deep shade under the vaults.
#include "generate/scenes.h"
#include "generate/shapes.h"

#include <array>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace diptych::core {
namespace {

constexpr float half_court = 6, bay = 2.4F, gallery_floor = 0.3F, springing = 3.3F, arcade_top = 4.7F;
constexpr int bays = 5;

/// A square ring around the y axis, closed: outer and inner half side, from `low` to `high`.
void add_ring(Primitive& out, float outer, float inner, float low, float high) {
    const auto corner = [](float half, float y, int i) {
        constexpr std::array<glm::vec2, 4> signs{{{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}};  // counter-clockwise from above
        const glm::vec2 s = signs[std::size_t(i % 4)];
        return glm::vec3(half * s.x, y, half * s.y);
    };
    for (int i = 0; i < 4; ++i) {
        add_quad(out, corner(outer, high, i), corner(outer, high, i + 1), corner(inner, high, i + 1),
                 corner(inner, high, i));
        add_quad(out, corner(outer, low, i + 1), corner(outer, low, i), corner(inner, low, i),
                 corner(inner, low, i + 1));
        add_quad(out, corner(outer, low, i), corner(outer, low, i + 1), corner(outer, high, i + 1),
                 corner(outer, high, i));
        add_quad(out, corner(inner, low, i + 1), corner(inner, low, i), corner(inner, high, i),
                 corner(inner, high, i + 1));
    }
}

/// One bay of wall over a semicircular arch: x in [-bay/2, bay/2], y from the springing (0) up, z in [-0.2, 0.2]; no
/// end faces, as the next bay goes on there.
Primitive make_arch(int material) {
    Primitive out;
    out.material = material;
    constexpr float radius = 1, half = bay / 2, top = arcade_top - springing, z = 0.2F;
    constexpr int segments = 24;
    std::array<glm::vec2, segments + 3> edge;
    edge[0] = {-half, 0};
    for (int i = 0; i <= segments; ++i) {
        const double angle = glm::pi<double>() * (1 - double(i) / segments);
        edge[std::size_t(i) + 1] = {float(radius * std::cos(angle)),
                                    i % segments == 0 ? 0.0F : float(radius * std::sin(angle))};
    }
    edge[segments + 2] = {half, 0};
    for (std::size_t i = 0; i + 1 < edge.size(); ++i) {
        const glm::vec2 a = edge[i], b = edge[i + 1];
        add_quad(out, {a, z}, {b, z}, {b.x, top, z}, {a.x, top, z});
        add_quad(out, {b, -z}, {a, -z}, {a.x, top, -z}, {b.x, top, -z});
        add_quad(out, {a, -z}, {b, -z}, {b, z}, {a, z});
        add_quad(out, {a.x, top, z}, {b.x, top, z}, {b.x, top, -z}, {a.x, top, -z});
    }
    return out;
}

/// A column on its plinth, from y = 0 to the springing, a little sunk into floor and arcade.
std::vector<Primitive> make_column(int stone) {
    constexpr float height = springing - gallery_floor;
    Primitive blocks;
    blocks.material = stone;
    add_box(blocks, {-0.28F, -0.05F, -0.28F}, {0.28F, 0.15F, 0.28F});
    add_box(blocks, {-0.29F, height - 0.15F, -0.29F}, {0.29F, height + 0.02F, 0.29F});
    const std::array<glm::vec2, 13> profile{{{0.26F, 0.14F},
                                             {0.27F, 0.18F},
                                             {0.26F, 0.22F},
                                             {0.22F, 0.25F},
                                             {0.215F, 0.9F},
                                             {0.21F, 1.4F},
                                             {0.2F, 1.9F},
                                             {0.185F, 2.5F},
                                             {0.2F, 2.52F},
                                             {0.2F, 2.56F},
                                             {0.185F, 2.58F},
                                             {0.21F, 2.72F},
                                             {0.27F, height - 0.14F}}};
    return {blocks, make_lathe(profile, 32, stone)};
}

void add_paving(Scene& scene, int light, int dark) {
    std::array<Primitive, 2> tiles;
    tiles[0].material = light;
    tiles[1].material = dark;
    constexpr int count = 12;
    constexpr float size = 0.95F;
    for (int row = 0; row < count; ++row) {
        for (int column = 0; column < count; ++column) {
            const float x0 = size * float(column - count / 2), x1 = size * float(column + 1 - count / 2);
            const float z0 = size * float(row - count / 2), z1 = size * float(row + 1 - count / 2);
            add_quad(tiles[std::size_t(row + column) % 2], {x0, 0, z1}, {x1, 0, z1}, {x1, 0, z0}, {x0, 0, z0});
        }
    }
    add_object(scene, "paving", {tiles[0], tiles[1]});
}

void add_fountain(Scene& scene, int stone) {
    const std::array<glm::vec2, 6> basin{
        {{1.7F, -0.05F}, {1.7F, 0.1F}, {1.5F, 0.1F}, {1.5F, 0.5F}, {1.3F, 0.5F}, {1.3F, 0.2F}}};
    const std::array<glm::vec2, 2> surface{{{1.35F, 0.4F}, {0, 0.4F}}};
    const std::array<glm::vec2, 4> stem{{{0.25F, 0.3F}, {0.12F, 0.6F}, {0.12F, 1.2F}, {0.2F, 1.35F}}};
    const int water = add_material(scene, make_material("water", {0.02F, 0.06F, 0.07F}, 0, 0.05F));
    const int gold = add_material(scene, make_material("gold", {1, 0.77F, 0.34F}, 1, 0.2F));
    add_object(scene, "fountain",
               {make_lathe(basin, 64, stone), make_lathe(surface, 64, water), make_lathe(stem, 32, stone)});
    add_object(scene, "orb", {make_sphere(0.35F, 64, 32, gold)}, translation(0, 1.65, 0));
}

}  // namespace

GeneratedScene generate_courtyard(const GenerateOptions&) {
    GeneratedScene out;
    Scene& scene = out.scene;
    scene.name = "courtyard";
    scene.environment.kind = Environment::Kind::constant;
    scene.environment.scale = {1.8F, 2.1F, 2.6F};
    out.recommended.environment = "1.8,2.1,2.6";

    const int stone = add_material(scene, make_material("stone", {0.62F, 0.56F, 0.46F}, 0, 0.8F));
    const int plaster = add_material(scene, make_material("plaster", {0.7F, 0.38F, 0.25F}, 0, 0.9F));
    const int slab = add_material(scene, make_material("slab", {0.5F, 0.47F, 0.42F}, 0, 0.35F));
    const int dark = add_material(scene, make_material("dark slab", {0.2F, 0.19F, 0.18F}, 0, 0.35F));

    Primitive gallery, walls, roof;
    gallery.material = slab;
    walls.material = plaster;
    roof.material = stone;
    add_ring(gallery, 9.1F, 5.6F, -0.2F, gallery_floor);
    add_ring(walls, 9.3F, 9, -0.1F, 4.8F);
    add_ring(roof, 9.5F, 5.5F, arcade_top - 0.05F, 5.0F);
    add_object(scene, "gallery", {gallery});
    add_object(scene, "walls", {walls});
    add_object(scene, "roof", {roof});
    add_paving(scene, slab, dark);
    add_fountain(scene, stone);

    const int column = add_mesh(scene, "column", make_column(stone));
    const int arch = add_mesh(scene, "arch", {make_arch(stone)});
    Primitive pier_box;
    pier_box.material = stone;
    add_box(pier_box, {-0.23F, -0.01F, -0.23F}, {0.23F, 1.38F, 0.23F});
    const int pier = add_mesh(scene, "pier", {pier_box});
    for (int side = 0; side < 4; ++side) {
        const glm::dmat4 turn = glm::rotate(glm::dmat4(1), side * glm::half_pi<double>(), glm::dvec3(0, 1, 0));
        const std::string suffix = " " + std::to_string(side + 1) + "-";
        add_instance(scene, "pier " + std::to_string(side + 1), pier,
                     turn * translation(-double(half_court), double(springing), double(half_court)));
        for (int i = 0; i < bays; ++i) {
            const double x = -double(half_court) + i * double(bay);
            const std::string name = suffix + std::to_string(i + 1);
            add_instance(scene, "column" + name, column,
                         turn * translation(x, double(gallery_floor), double(half_court)));
            add_instance(scene, "arch" + name, arch,
                         turn * translation(x + double(bay) / 2, double(springing), double(half_court)));
        }
    }
    // Turns by right angles are exact, so that the file does not depend on how a machine rounds sine and cosine.
    for (Instance& instance : scene.instances) {
        for (int c = 0; c < 3; ++c) {
            for (int r = 0; r < 3; ++r) {
                instance.object_to_world[c][r] = std::round(instance.object_to_world[c][r]);
            }
        }
    }
    for (Instance& instance : scene.instances) {
        for (int r = 0; r < 3; ++r) {
            instance.object_to_world[3][r] = std::round(instance.object_to_world[3][r] * 1e6) / 1e6;
        }
    }

    scene.cameras.push_back(make_camera("camera", {-8.6, 1.75, 3.6}, {0, 2.0, -0.5}, 60));
    scene.cameras.push_back(make_camera("court", {4.6, 1.7, 5.0}, {-2.0, 2.0, -3.0}, 60));
    return out;
}

}  // namespace diptych::core
