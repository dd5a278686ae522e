// Packed lights against the world: places, sides, probabilities.
#include <cmath>
#include <numbers>

#include "pack_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

constexpr double pi = std::numbers::pi;

RenderSettings path_settings() {
    RenderSettings s = brdf_settings();
    s.integrator = Integrator::path;
    return s;
}

/// Some black triangles of one mesh, two of whose three primitives emit, placed twice, once mirrored.
Scene lit_scene() {
    Scene scene;
    scene.name = "lit";
    const int black = add_material(scene, make_material("black", glm::vec3(0), 0, 1));
    const int red = add_material(scene, make_emitter("red", {4, 0, 0}));
    Material both = make_emitter("both", {0, 1, 0});
    both.double_sided = true;
    const int green = add_material(scene, both);
    Primitive a;
    a.material = black;
    add_quad(a, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    Primitive b;
    b.material = red;
    add_quad(b, {0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {0, 1, 1});
    Primitive c;
    c.material = green;
    add_quad(c, {0, 0, 2}, {1, 0, 2}, {1, 3, 2.5F}, {0, 3, 2});
    const int mesh = add_mesh(scene, "three", {a, b, c});
    Primitive plain;
    plain.material = black;
    add_quad(plain, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    add_object(scene, "dark", {plain});
    add_instance(scene, "straight", mesh, translation(5, 6, 7));
    glm::dmat4 flip = translation(-1, 2, -3);
    flip[0] = {-2, 0.5, 0, 0};
    flip[1] = {0, 1, 0.25, 0};
    add_instance(scene, "mirrored", mesh, flip);
    scene.cameras.push_back(make_camera("camera", {10, 20, 30}, {0, 0, 0}, 45));
    return scene;
}

}  // namespace

TEST_CASE("Emissive triangles stand where the world has them, and know their side") {
    const Scene scene = lit_scene();
    const PackedScene packed = pack_scene(scene, path_settings());
    REQUIRE(packed.emissive_triangles.size() == 8);
    REQUIRE(packed.instances.size() == 3);
    CHECK(packed.instances[0].first_emitter_slot == shared::NONE);
    const glm::dvec3 camera(10, 20, 30);
    for (std::size_t i = 1; i < 3; ++i) {
        const Instance& instance = scene.instances[i];
        const std::uint32_t slot = packed.instances[i].first_emitter_slot;
        REQUIRE(slot != shared::NONE);
        CHECK(packed.emitter_slots.at(slot) == shared::NONE);
        for (std::uint32_t g = 1; g < 3; ++g) {
            const Primitive& primitive = scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives[g];
            for (std::uint32_t t = 0; t < 2; ++t) {
                const std::uint32_t id = packed.emitter_slots.at(slot + g) + t;
                const shared::EmissiveTriangle& light = packed.emissive_triangles.at(id);
                const auto world = [&](std::uint32_t v) {
                    return glm::dvec3(instance.object_to_world * glm::dvec4(primitive.positions[v], 1)) - camera;
                };
                const glm::uvec3 triangle = primitive.triangles[t];
                const glm::dvec3 a = world(triangle.x);
                CHECK(glm::length(glm::dvec3(light.vertex_0) - a) < 1e-5);
                CHECK(glm::length(glm::dvec3(light.edge_1) - (world(triangle.y) - a)) < 1e-5);
                CHECK(glm::length(glm::dvec3(light.edge_2) - (world(triangle.z) - a)) < 1e-5);
                CHECK(light.primitive == t);
                CHECK(packed.geometries[light.geometry].material == static_cast<std::uint32_t>(primitive.material));
                CHECK(((light.flags & shared::EMITTER_TWO_SIDED) != 0) == (g == 2));
                CHECK((light.flags & shared::EMITTER_VARIES) == 0);
                // The front goes as normals go, by the inverse transpose.
                const glm::dmat3 m(instance.object_to_world);
                const glm::dvec3 local = glm::cross(
                    glm::dvec3(primitive.positions[triangle.y]) - glm::dvec3(primitive.positions[triangle.x]),
                    glm::dvec3(primitive.positions[triangle.z]) - glm::dvec3(primitive.positions[triangle.x]));
                const glm::dvec3 front = glm::transpose(glm::inverse(m)) * local;
                CHECK(glm::length(glm::normalize(front) - glm::dvec3(light.front)) < 1e-5);
                const double double_area = glm::length(glm::cross(world(triangle.y) - a, world(triangle.z) - a));
                CHECK(static_cast<double>(light.double_area) == Approx(double_area).epsilon(1e-5));
            }
        }
    }
    CHECK(packed.instances[2].mirrored == 1);
    CHECK(packed.instances[1].mirrored == 0);
}

TEST_CASE("Lights are picked by power, beside a defensive share") {
    Scene scene = lit_scene();
    PunctualLight lamp;
    lamp.intensity = glm::vec3(0.7F);
    scene.lights.push_back(lamp);
    const PackedScene packed = pack_scene(scene, path_settings());
    REQUIRE(packed.light_table.size() == 9);
    std::vector<double> power;
    for (const shared::EmissiveTriangle& light : packed.emissive_triangles) {
        const double area = 0.5 * glm::length(glm::cross(glm::dvec3(light.edge_1), glm::dvec3(light.edge_2)));
        const bool both = (light.flags & shared::EMITTER_TWO_SIDED) != 0;
        const double luminance = light.radiance.x > 0 ? 0.2126 * 4 : 0.7152;
        power.push_back(area * pi * luminance * (both ? 2 : 1));
    }
    power.push_back(4 * pi * 0.7);
    double sum = 0;
    for (const double p : power) {
        sum += p;
    }
    double pmf_sum = 0;
    for (std::size_t i = 0; i < power.size(); ++i) {
        const double pmf =
            static_cast<double>(i < 8 ? packed.emissive_triangles[i].pmf : packed.punctual_lights[0].pmf);
        pmf_sum += pmf;
        CHECK(pmf == Approx(0.95 * power[i] / sum + 0.05 / 9).epsilon(1e-5));
    }
    CHECK(pmf_sum == Approx(1).epsilon(1e-6));
}

TEST_CASE("Lights from afar have the power that they bring to the scene's sphere, spots that of their cone") {
    Scene scene = lit_scene();
    scene.meshes[0].primitives[0].positions[0] *= 3.0F;  // so that no radius is 1
    scene.environment.kind = EnvironmentKind::constant;
    scene.environment.scale = glm::vec3(0.3F);
    PunctualLight sun;
    sun.type = PunctualType::directional;
    sun.intensity = glm::vec3(2);
    PunctualLight spot;
    spot.type = PunctualType::spot;
    spot.intensity = glm::vec3(5);
    spot.inner_cone = 0.3;
    spot.outer_cone = 0.5;
    scene.lights = {sun, spot};
    const PackedScene packed = pack_scene(scene, path_settings());
    const double r = packed.radius;
    REQUIRE(std::abs(r - 1) > 0.1);
    const std::size_t emitters = packed.emissive_triangles.size();
    REQUIRE(packed.light_powers.size() == emitters + 3);
    CHECK(packed.light_powers[emitters] == Approx(pi * r * r * 2));
    CHECK(packed.light_powers[emitters + 1] == Approx(2 * pi * 5 * (1 - 0.5 * (std::cos(0.3) + std::cos(0.5)))));
    CHECK(packed.light_powers[emitters + 2] == Approx(4 * pi * pi * r * r * 0.3));
    // KHR_lights_punctual: full light within the inner cone, none beyond the outer one, in between by the cosine.
    const shared::PunctualLight& cone = packed.punctual_lights[1];
    const auto falloff = [&](double cosine) { return cosine * static_cast<double>(cone.cone_scale) + static_cast<double>(cone.cone_offset); };
    CHECK(falloff(std::cos(0.3)) == Approx(1).epsilon(1e-5));
    CHECK(falloff(std::cos(0.5)) == Approx(0).margin(1e-5));
    CHECK(falloff(0.5 * (std::cos(0.3) + std::cos(0.5))) == Approx(0.5).epsilon(1e-5));
}

TEST_CASE("Emitters without area are never lights, and the rest share all") {
    Scene scene = lit_scene();
    Primitive& red = scene.meshes[0].primitives[1];
    red.positions[3] = red.positions[2];  // the second triangle is a line
    const PackedScene packed = pack_scene(scene, path_settings());
    double sum = 0;
    int none_of_it = 0;
    for (std::size_t i = 0; i < packed.emissive_triangles.size(); ++i) {
        const shared::EmissiveTriangle& light = packed.emissive_triangles[i];
        const bool flat = glm::length(glm::cross(light.edge_1, light.edge_2)) == 0;
        CHECK((light.pmf == 0) == flat);
        if (flat) {
            ++none_of_it;
            CHECK(packed.light_table[i].probability == 0);
            CHECK(packed.light_table[i].alias != i);
        }
        sum += static_cast<double>(light.pmf);
    }
    CHECK(none_of_it == 2);
    CHECK(sum == Approx(1).epsilon(1e-6));
}

TEST_CASE("Textured emitters weigh by the mean of their texture over each triangle") {
    Scene scene = least_scene();
    TextureImage image;
    image.name = "halves";
    image.width = 64;
    image.height = 64;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const bool on = x > y;
            image.rgba.insert(image.rgba.end(), 4, on ? 255 : 0);
        }
    }
    scene.images.push_back(image);
    scene.textures.push_back({"halves", 0, Wrap::clamp, Wrap::clamp, Filter::nearest});
    scene.materials[0].emission = glm::vec3(1);
    scene.materials[0].emission_texture.texture = 0;
    // Triangle 0 is a b c, where x > y in texture space; triangle 1 is a c d.
    scene.meshes[0].primitives[0].uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const PackedScene packed = pack_scene(scene, path_settings());
    REQUIRE(packed.emissive_triangles.size() == 2);
    CHECK(packed.emissive_triangles[0].pmf > 0.95F);
    CHECK(packed.emissive_triangles[1].pmf >= 0.025F);  // the defensive share at least
    CHECK((packed.emissive_triangles[0].flags & shared::EMITTER_VARIES) != 0);
}

TEST_CASE("A map's probabilities add up to 1 and leave out nothing that filtering lights") {
    Scene scene = least_scene();
    Environment& e = scene.environment;
    e.kind = Environment::Kind::map;
    e.width = 16;
    e.height = 8;
    e.texels.assign(128, glm::vec3(0));
    e.texels[3 * 16 + 0] = glm::vec3(1e6F);  // at the seam
    e.texels[0 * 16 + 7] = glm::vec3(5);     // at the pole
    const PackedScene packed = pack_scene(scene, path_settings());
    double sum = 0;
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 16; ++x) {
            const auto pmf = static_cast<double>(packed.environment_texels[static_cast<std::size_t>(y * 16 + x)].w);
            sum += pmf;
            const bool by_seam = std::abs(y - 3) <= 1 && (x <= 1 || x == 15);
            const bool by_pole = y <= 1 && std::abs(x - 7) <= 1;
            INFO("texel " << x << " " << y);
            CHECK((pmf > 0) == (by_seam || by_pole));
        }
    }
    CHECK(sum == Approx(1).epsilon(1e-5));
    CHECK(packed.constants.environment.pmf == Approx(1));
    CHECK(packed.constants.environment.size == shared::uvec2(16, 8));
}

TEST_CASE("A black sky is no light") {
    Scene scene = least_scene();
    scene.environment.kind = Environment::Kind::map;
    scene.environment.width = 4;
    scene.environment.height = 2;
    scene.environment.texels.assign(8, glm::vec3(0));
    const PackedScene packed = pack_scene(scene, path_settings());
    CHECK(packed.light_table.empty());
    CHECK(packed.environment_table.empty());
    CHECK(packed.constants.light_count == 0);
}

TEST_CASE("Emitters are too near to be left to their power within about the width of all that shines") {
    Scene scene = least_scene();
    RenderSettings settings = path_settings();
    settings.integrator = Integrator::ris;
    CHECK(pack_scene(scene, settings).constants.resampling.reach == 0.0F);

    const auto add_square = [&](float side, bool double_sided) {
        Material material = make_emitter("lamp", glm::vec3(3));
        material.double_sided = double_sided;
        Primitive square;
        square.material = add_material(scene, material);
        add_quad(square, {0, 5, 0}, {side, 5, 0}, {side, 5, side}, {0, 5, side});
        add_object(scene, "lamp", {square});
    };
    add_square(2, true);
    CHECK(pack_scene(scene, settings).constants.resampling.reach == Approx(2).epsilon(1e-5));
    add_square(1.5F, true);
    CHECK(pack_scene(scene, settings).constants.resampling.reach == Approx(2.5).epsilon(1e-5));

    scene.environment.kind = EnvironmentKind::constant;  // takes its share of the picks
    scene.environment.scale = glm::vec3(0.1F);
    const PackedScene packed = pack_scene(scene, settings);
    double share = 0;
    for (const shared::EmissiveTriangle& light : packed.emissive_triangles) {
        share += static_cast<double>(light.pmf);
    }
    CHECK(share < 0.9);
    CHECK(packed.constants.resampling.reach == Approx(2.5 / std::sqrt(share)).epsilon(1e-5));
}
