// Scenes at the extremes of what fp32 and real files bring: scales, distances, lights close and small, surfaces that
// overlap, broken meshes, steep normals. Each is small and diffuse where it can be, so that a comparison with the
// oracle soon has power.
#include "generate/scenes.h"
#include "generate/shapes.h"

#include <cmath>
#include <limits>
#include <utility>

namespace diptych::core {
namespace {

Material matte(const char* name, const glm::vec3& color) {
    Material out = make_material(name, color, 0, 1);
    out.specular = 0;
    return out;
}

/// Rotations whose sines and cosines are quotients, so that no machine rounds them another way.
glm::dmat4 askew() {
    const glm::dmat3 about_y(0.8, 0, -0.6, 0, 1, 0, 0.6, 0, 0.8);
    const glm::dmat3 about_x(1, 0, 0, 0, 12.0 / 13, 5.0 / 13, 0, -5.0 / 13, 12.0 / 13);
    return glm::dmat4(about_y * about_x);
}

glm::dmat4 scaling(double x, double y, double z) {
    glm::dmat4 out(1);
    out[0].x = x;
    out[1].y = y;
    out[2].z = z;
    return out;
}

Primitive box(const glm::vec3& low, const glm::vec3& high, int material, bool inside) {
    Primitive out;
    out.material = material;
    add_box(out, low, high);
    if (inside) {
        for (glm::uvec3& triangle : out.triangles) {
            std::swap(triangle.y, triangle.z);
        }
    }
    return out;
}

Primitive level(const glm::vec3& center, float half, bool up, int material) {
    Primitive out;
    out.material = material;
    const glm::vec3 x(half, 0, 0), z(0, 0, up ? -half : half);
    add_quad(out, center - x - z, center + x - z, center + x + z, center - x + z);
    return out;
}

Primitive faceted_ball(float radius, int material) {
    Primitive out = make_sphere(radius, 16, 8, material);
    out.normals.clear();
    return out;
}

/// A room of two units with a lamp, a block and a ball, anywhere and of any size.
Scene furnished_room(const char* name, const glm::dmat4& place, float albedo) {
    Scene scene;
    scene.name = name;
    const int white = add_material(scene, matte("white", glm::vec3(albedo)));
    const int red = add_material(scene, matte("red", {0.7F * albedo, 0.2F * albedo, 0.15F * albedo}));
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(5)));
    add_object(scene, "room", {box(glm::vec3(-1), glm::vec3(1), white, true)}, place);
    add_object(scene, "lamp", {level({0, 0.95F, 0}, 0.35F, false, lamp)}, place);
    add_object(scene, "block", {box({-0.25F, -0.4F, -0.25F}, {0.25F, 0.4F, 0.25F}, white, false)},
               place * translation(-0.4, -0.55, -0.3) * askew());
    add_object(scene, "ball", {faceted_ball(0.3F, red)}, place * translation(0.45, -0.65, 0));
    const glm::dvec3 eye(place * glm::dvec4(0.1, 0.1, 0.95, 1)), target(place * glm::dvec4(0, -0.15, -1, 1));
    scene.cameras.push_back(make_camera("camera", eye, target, 70));
    return scene;
}

}  // namespace

GeneratedScene generate_extreme_instances(const GenerateOptions&) {
    GeneratedScene out{furnished_room("instances", glm::dmat4(1), 0.7F), {}};
    Scene& scene = out.scene;
    const int blue = add_material(scene, matte("blue", {0.2F, 0.3F, 0.7F}));
    Primitive cone;
    cone.material = blue;
    const glm::vec2 profile[] = {{0.2F, -0.2F}, {0, 0.3F}};
    cone = make_lathe(profile, 24, blue);
    add_quad(cone, {-0.2F, -0.2F, -0.2F}, {0.2F, -0.2F, -0.2F}, {0.2F, -0.2F, 0.2F}, {-0.2F, -0.2F, 0.2F});
    cone.normals.resize(cone.positions.size(), {0, -1, 0});
    const int mesh = add_mesh(scene, "cone", {cone});
    glm::dmat4 sheared(1);
    sheared[1].x = 1.5;
    sheared[2].y = -0.7;
    add_instance(scene, "mirrored", mesh, translation(-0.5, 0.3, -0.5) * scaling(-1, 1, 1) * askew());
    add_instance(scene, "sheared", mesh, translation(0.3, 0.25, -0.6) * sheared);
    add_instance(scene, "mirrored and sheared", mesh,
                 translation(0.5, -0.1, -0.2) * scaling(1, -1, 1) * sheared * askew());
    add_instance(scene, "flattened", mesh, translation(0, 0.4, -0.7) * askew() * scaling(1.5, 0.8, 1e-3));
    add_instance(scene, "stretched", mesh, translation(-0.75, 0, -0.1) * scaling(0.05, 3, 0.05));
    return out;
}

GeneratedScene generate_extreme_near_lamp(const GenerateOptions&) {
    GeneratedScene out;
    Scene& scene = out.scene;
    scene.name = "near-lamp";
    const int grey = add_material(scene, matte("grey", glm::vec3(0.6F)));
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(1)));
    add_object(scene, "plane", {level(glm::vec3(0), 1, true, grey)});
    add_object(scene, "lamp", {level({0, 1e-3F, 0}, 2e-3F, false, lamp)});
    scene.cameras.push_back(make_camera("camera", {0, 4e-4, 0.012}, {0, 0, 0}, 30));
    out.recommended.environment = "none";  // dark but for a few square millimetres
    return out;
}

GeneratedScene generate_extreme_sun(const GenerateOptions&) {
    GeneratedScene out;
    Scene& scene = out.scene;
    scene.name = "sun";
    const int white = add_material(scene, matte("white", glm::vec3(0.7F)));
    const int sun = add_material(scene, make_emitter("sun", glm::vec3(2e5F)));
    add_object(scene, "ground", {level(glm::vec3(0), 5, true, white)});
    add_object(scene, "wall", {box({-0.6F, 0, -0.4F}, {0.2F, 1, -0.2F}, white, false)});
    add_object(scene, "ball", {faceted_ball(0.3F, white)}, translation(0.7, 0.35, 0.2));
    // A disc of 1e-5 sr a kilometre away; a 32-gon of the same area.
    Primitive disc;
    disc.material = sun;
    const double radius = 1000 * std::sqrt(1e-5 / (16 * std::sin(3.14159265358979 / 16)));
    disc.positions.push_back(glm::vec3(0));
    for (int i = 0; i < 32; ++i) {
        const double angle = 3.14159265358979 * i / 16;
        disc.positions.push_back(glm::vec3(radius * std::cos(angle), 0, radius * std::sin(angle)));
        disc.triangles.push_back({0, std::uint32_t(1 + i), std::uint32_t(1 + (i + 1) % 32)});
    }
    add_object(scene, "sun", {disc}, scaling(1, 1, 1) * askew() * translation(0, 1000, 0));
    scene.cameras.push_back(make_camera("camera", {0.5, 1.2, 3}, {0, 0.3, 0}, 40));
    return out;
}

GeneratedScene generate_extreme_far_room(const GenerateOptions&) {
    return {furnished_room("far-room", translation(1e5, -3e4, 7e4), 0.7F), {}};
}

GeneratedScene generate_extreme_macro(const GenerateOptions&) {
    return {furnished_room("macro", scaling(5e-6, 5e-6, 5e-6), 0.7F), {}};
}

GeneratedScene generate_extreme_wide(const GenerateOptions&) {
    GeneratedScene out;
    Scene& scene = out.scene;
    scene.name = "wide";
    const int white = add_material(scene, matte("white", glm::vec3(0.7F)));
    const int lamp = add_material(scene, make_emitter("lamp", {3, 2.5F, 2}));
    add_object(scene, "ground", {level(glm::vec3(0), 5e5F, true, white)});
    add_object(scene, "lamp", {level({0, 2e5F, 0}, 2e5F, false, lamp)});
    add_object(scene, "house", {box({-4, 0, -12}, {4, 6, -6}, white, false)});
    add_object(scene, "mountain", {faceted_ball(3e4F, white)}, translation(4e4, 0, -1.5e5));
    add_object(scene, "stone", {box({-0.1F, 0, -0.1F}, {0.1F, 0.15F, 0.1F}, white, false)}, translation(0.5, 0, -1.5));
    scene.cameras.push_back(make_camera("camera", {0, 1.6, 3}, {0, 1.5, -6}, 60));
    return out;
}

GeneratedScene generate_extreme_white_room(const GenerateOptions&) {
    GeneratedScene out;
    Scene& scene = out.scene;
    scene.name = "white-room";
    const int white = add_material(scene, matte("white", glm::vec3(0.999F)));
    Material glow = matte("glow", glm::vec3(0.999F));
    glow.emission = glm::vec3(0.01F);
    const int lamp = add_material(scene, glow);
    add_object(scene, "room", {box(glm::vec3(-1), glm::vec3(1), lamp, true)});
    add_object(scene, "block", {box({-0.25F, -0.4F, -0.25F}, {0.25F, 0.4F, 0.25F}, white, false)},
               translation(-0.4, -0.5, -0.3) * askew());
    scene.cameras.push_back(make_camera("camera", {0.1, 0.1, 0.95}, {0, -0.15, -1}, 70));
    out.recommended.max_depth = 64;
    return out;
}

GeneratedScene generate_extreme_coplanar(const GenerateOptions&) {
    GeneratedScene out{furnished_room("coplanar", glm::dmat4(1), 0.7F), {}};
    Scene& scene = out.scene;
    const int white = 0;
    // The floor twice more, the second in part; a block that stands in it, its bottom in the floor's plane; two that
    // share a face.
    add_object(scene, "floor again", {level({0, -1, 0}, 1, true, white)});
    add_object(scene, "rug", {level({0.3F, -1, 0.3F}, 0.4F, true, white)});
    add_object(scene, "standing", {box({-0.9F, -1, -0.9F}, {-0.5F, -0.3F, -0.5F}, white, false)});
    add_object(scene, "left", {box({0.2F, -1, -0.9F}, {0.5F, 0, -0.6F}, white, false)});
    add_object(scene, "right", {box({0.5F, -1, -0.9F}, {0.8F, 0.3F, -0.6F}, white, false)});
    add_object(scene, "through", {box({0.1F, -1.2F, -0.7F}, {0.9F, -0.7F, -0.3F}, white, false)});
    return out;
}

GeneratedScene generate_extreme_broken_mesh(const GenerateOptions&) {
    GeneratedScene out{furnished_room("broken-mesh", glm::dmat4(1), 0.7F), {}};
    Scene& scene = out.scene;
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const int lamp = 2;
    for (const int material : {0, lamp}) {
        Primitive& broken = scene.meshes[material == lamp ? 1 : 0].primitives[0];
        const auto count = static_cast<std::uint32_t>(broken.positions.size());
        const glm::vec3 a = broken.positions[0], b = broken.positions[1];
        // Two that repeat a vertex, one whose vertices lie on a line, one of a point, two with a vertex that is no
        // number.
        broken.positions.insert(broken.positions.end(), {b, 0.5F * (a + b), {nan, 0, 0}, {0, nan, 0}});
        broken.triangles.insert(
            broken.triangles.end(),
            {{0, 1, 1}, {0, 1, count}, {0, 1, count + 1}, {0, 0, 0}, {0, 1, count + 2}, {0, count + 3, 2}});
    }
    return out;
}

GeneratedScene generate_extreme_normal_map(const GenerateOptions&) {
    GeneratedScene out;
    Scene& scene = out.scene;
    scene.name = "normal-map-85";
    // Four quarters, each tilted by 85 degrees another way.
    TextureImage image;
    image.name = "tilted";
    image.width = image.height = 8;
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
            const double across = 0.9962, up = 0.0872;
            const bool right = x >= 4, low = y >= 4;
            const double nx = right == low ? (right ? across : -across) : 0,
                         ny = right == low ? 0 : (right ? across : -across);
            for (const double c : {nx, ny, up}) {
                image.rgba.push_back(std::uint8_t(std::lround(255 * (0.5 + 0.5 * c))));
            }
            image.rgba.push_back(255);
        }
    }
    scene.images.push_back(image);
    Texture texture;
    texture.name = "tilted";
    texture.image = 0;
    texture.filter = Filter::nearest;
    scene.textures.push_back(texture);
    for (const bool metal : {false, true}) {
        Material m = metal ? make_material("metal", glm::vec3(0.9F), 1, 0.6F) : matte("white", glm::vec3(0.9F));
        m.normal_texture.texture = 0;
        const int material = add_material(scene, m);
        Primitive wall;
        wall.material = material;
        const float x = metal ? 0.05F : -1.05F;
        add_quad(wall, {x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0});
        wall.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
        wall.normals.assign(4, {0, 0, 1});
        wall.tangents.assign(4, {1, 0, 0, 1});
        add_object(scene, metal ? "metal" : "white", {wall});
    }
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(2)));
    add_object(scene, "lamp", {level({0, 2.2F, 1.2F}, 1, false, lamp)});
    const int grey = add_material(scene, matte("grey", glm::vec3(0.5F)));
    add_object(scene, "floor", {level({0, -0.05F, 0}, 3, true, grey)});
    scene.cameras.push_back(make_camera("camera", {0.3, 0.6, 2.4}, {0, 0.45, 0}, 45));
    return out;
}

GeneratedScene generate_extreme_terminator(const GenerateOptions&) {
    GeneratedScene out;
    Scene& scene = out.scene;
    scene.name = "terminator";
    const int white = add_material(scene, matte("white", glm::vec3(0.8F)));
    const int glossy = add_material(scene, make_material("glossy", {0.8F, 0.5F, 0.3F}, 1, 0.4F));
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(12)));
    add_object(scene, "floor", {level({0, -0.6F, 0}, 3, true, white)});
    add_object(scene, "white", {make_sphere(0.5F, 7, 5, white)}, translation(-0.6, 0, 0));
    add_object(scene, "glossy", {make_sphere(0.5F, 7, 5, glossy)}, translation(0.6, 0, 0));
    add_object(scene, "lamp", {level({0, 0, 0}, 0.5F, false, lamp)}, translation(1.5, 2, 0.5) * askew());
    scene.cameras.push_back(make_camera("camera", {0, 0.5, 3}, {0, -0.1, 0}, 45));
    return out;
}

}  // namespace diptych::core
