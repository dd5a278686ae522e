// A packed scene at another moment is the scene packed at that moment.
#include <cstring>

#include "error.h"
#include "pack_fixture.h"
#include "generate/generate.h"
#include "pose/pose.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

RenderSettings path_settings() {
    RenderSettings s = brdf_settings();
    s.integrator = Integrator::path;
    return s;
}

template <typename T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void check_same(const PackedScene& a, const PackedScene& b) {
#define CHECK_BUFFER(Type, name)                                                                                       \
    {                                                                                                                  \
        INFO(#name);                                                                                                   \
        CHECK(same(a.name, b.name));                                                                                   \
    }
    SCENE_BUFFERS(CHECK_BUFFER)
#undef CHECK_BUFFER
    CHECK(std::memcmp(&a.constants, &b.constants, sizeof a.constants) == 0);
    CHECK(a.features == b.features);
    CHECK(a.instance_shown == b.instance_shown);
}

/// The lights that one instance's triangles are.
std::vector<shared::EmissiveTriangle> lights_of(const Scene& scene, const PackedScene& packed, const char* name) {
    std::vector<shared::EmissiveTriangle> lights;
    for (std::size_t i = 0; i < packed.instances.size(); ++i) {
        if (scene.instances[packed.scene_instances[i]].name == name) {
            const std::uint32_t first = packed.emitter_slots.at(packed.instances[i].first_emitter_slot);
            lights.assign(packed.emissive_triangles.begin() + first, packed.emissive_triangles.begin() + first + 2);
        }
    }
    return lights;
}

/// The least scene, its square a lamp of one emission that goes from 0 at 0 s to 4 at 1 s.
Scene lamp_scene() {
    Scene scene = least_scene();
    scene.materials[0].moving_emission = MovingEmission{glm::vec3(1), 0};
    scene.animations = {{"", {{AnimatedProperty::emissive_strength, 0, Interpolation::linear, {0, 1}, {0, 4}}}}};
    pose_scene(scene, 0);
    return scene;
}

}  // namespace

TEST_CASE("a moment has the bits of the scene packed then, whatever came before") {
    const Integrator integrator = GENERATE(Integrator::path, Integrator::brdf);
    Scene scene = generate_scene("moving-light").scene;
    RenderSettings settings = path_settings();
    settings.integrator = integrator;
    settings.light_sampler = LightSampler::power;  // a light tree keeps the form that it has at rest
    PackedScene moved = pack_scene(scene, settings);
    const std::vector<std::uint32_t> slots = moved.emitter_slots;
    for (const double seconds : {0.0, 0.5, 1.0, 3.7, 1.0, 2.0, 0.1}) {
        INFO(seconds);
        pose_scene(scene, seconds);
        pack_moment(scene, settings, moved);
        check_same(moved, pack_scene(scene, settings));
        CHECK(moved.emitter_slots == slots);
    }
}

TEST_CASE("the origin stays when the camera moves, so that a moment depends on no other") {
    Scene scene = generate_scene("moving-light").scene;
    RenderSettings settings = path_settings();
    settings.camera = 1;
    PackedScene moved = pack_scene(scene, settings);
    const PackedScene rest = moved;
    CHECK(moved.constants.camera.origin == shared::vec3(0));
    for (const double seconds : {1.0, 3.0, 2.0}) {
        pose_scene(scene, seconds);
        pack_moment(scene, settings, moved);
        const glm::dvec3 eye(scene.cameras[1].camera_to_world[3]);
        CHECK(glm::length(glm::dvec3(moved.constants.camera.origin) - (eye - rest.origin)) < 1e-6);
        PackedScene alone = rest;
        pack_moment(scene, settings, alone);
        check_same(moved, alone);
    }
}

TEST_CASE("a lamp that is off keeps its lights, dark and never picked") {
    Scene scene = generate_scene("moving-light").scene;
    const RenderSettings settings = path_settings();
    PackedScene packed = pack_scene(scene, settings);
    for (const double seconds : {0.0, 0.99, 1.0, 1.99, 2.0, 4.0}) {
        INFO(seconds);
        pose_scene(scene, seconds);
        pack_moment(scene, settings, packed);
        for (const shared::EmissiveTriangle& light : lights_of(scene, packed, "lamp that goes on")) {
            CHECK((light.pmf > 0) == (seconds >= 1));
            CHECK((light.radiance.x > 0) == (seconds >= 1));
        }
        for (const shared::EmissiveTriangle& light : lights_of(scene, packed, "lamp that goes off")) {
            CHECK((light.pmf > 0) == (seconds < 2));
        }
        CHECK(lights_of(scene, packed, "lamp that goes off").size() == 2);
        double sum = 0;
        for (const shared::EmissiveTriangle& light : packed.emissive_triangles) {
            sum += static_cast<double>(light.pmf);
        }
        for (const shared::PunctualLight& light : packed.punctual_lights) {
            sum += static_cast<double>(light.pmf);
        }
        CHECK(sum == Approx(1).epsilon(1e-6));
    }
}

TEST_CASE("a scene whose only light is off picks none, and finds it again") {
    Scene scene = lamp_scene();
    const RenderSettings settings = path_settings();
    PackedScene packed = pack_scene(scene, settings);
    const std::size_t table = packed.light_table.size();
    CHECK(table == 2);
    CHECK(packed.constants.light_count == 0);
    CHECK(packed.constants.emissive_triangle_count == 2);
    CHECK((packed.features & shared::FEATURE_EMISSIVE) != 0);
    CHECK((packed.features & shared::FEATURE_LIGHT_SAMPLING) != 0);
    for (const double seconds : {0.5, 0.0, 1.0}) {
        pose_scene(scene, seconds);
        pack_moment(scene, settings, packed);
        CHECK(packed.light_table.size() == table);
        CHECK(packed.constants.light_count == (seconds > 0 ? 2 : 0));
        CHECK(packed.emissive_triangles[0].pmf == (seconds > 0 ? 0.5F : 0.0F));
        CHECK(packed.materials[0].emission == glm::vec3(4 * static_cast<float>(seconds)));
    }
}

namespace {

/// The lamp's node scales to this within a second.
Scene scaled_lamp(const glm::vec3& scale) {
    Scene scene = lamp_scene();
    scene.nodes.emplace_back();
    scene.instances[0].node = 0;
    scene.animations[0].channels.push_back(
        {AnimatedProperty::scale, 0, Interpolation::linear, {0, 1}, {1, 1, 1, scale.x, scale.y, scale.z}});
    scene.animations[0].channels[0].values = {4, 4};
    return scene;
}

}  // namespace

TEST_CASE("A flat moment of an instance shows what is left of it, and one without area nothing") {
    for (const bool has_area : {true, false}) {
        Scene scene = scaled_lamp(has_area ? glm::vec3(1, 0, 1) : glm::vec3(1, 0, 0));
        PackedScene packed = pack_scene(scene, path_settings());
        CHECK(is_shown(packed, 0));
        pose_scene(scene, 1);
        pack_moment(scene, path_settings(), packed);
        REQUIRE(packed.instances.size() == 1);
        CHECK(is_shown(packed, 0) == has_area);
        CHECK((packed.emissive_triangles[0].pmf > 0) == has_area);
        CHECK((glm::length(glm::dvec3(packed.instances[0].row_1)) > 0) == has_area);
        const PackedScene begun_flat = pack_scene(scene, path_settings());
        CHECK(begun_flat.instances.size() == 1);
        CHECK(begun_flat.warnings.empty());
        pose_scene(scene, 0.5);
        pack_moment(scene, path_settings(), packed);
        CHECK(is_shown(packed, 0));
        CHECK(packed.emissive_triangles[0].pmf == 0.5F);
    }
}

TEST_CASE("a moment that leaves the range of single precision is refused") {
    Scene scene = scaled_lamp(glm::vec3(1e30F));
    PackedScene packed = pack_scene(scene, path_settings());
    pose_scene(scene, 1);
    CHECK_THROWS_WITH(pack_moment(scene, path_settings(), packed), Catch::Contains("from the camera"));
}

TEST_CASE("a textured lamp's mean follows its emission") {
    Scene scene = lamp_scene();
    scene.materials[0].emission_texture.texture = add_texture(scene);
    const RenderSettings settings = path_settings();
    PackedScene packed = pack_scene(scene, settings);
    for (const double seconds : {0.25, 1.0}) {
        pose_scene(scene, seconds);
        pack_moment(scene, settings, packed);
        check_same(packed, pack_scene(scene, settings));
        CHECK(packed.emitter_means.at(0) > 0);
    }
}

TEST_CASE("the moment of another scene is refused") {
    PackedScene packed = pack_scene(lamp_scene(), path_settings());
    Scene other = lamp_scene();
    other.materials.emplace_back();
    CHECK_THROWS_WITH(pack_moment(other, path_settings(), packed), Catch::Contains("materials: 2"));
    other = lamp_scene();
    other.instances.clear();
    CHECK_THROWS_WITH(pack_moment(other, path_settings(), packed), Catch::Contains("instances: 0"));
}

namespace {

/// The least scene under a map whose halves differ, beside a lamp, so that picking between lights matters.
Scene mapped_scene() {
    Scene scene = least_scene();
    scene.environment.kind = EnvironmentKind::map;
    scene.environment.width = 4;
    scene.environment.height = 2;
    for (int i = 0; i < 8; ++i) {
        scene.environment.texels.emplace_back(0.3F * static_cast<float>(i % 4), 0.1F, 0.7F);
    }
    scene.lights.emplace_back();
    return scene;
}

}  // namespace

TEST_CASE("an environment turns and dims as if it were packed anew") {
    for (const EnvironmentKind kind : {EnvironmentKind::map, EnvironmentKind::constant}) {
        Scene scene = mapped_scene();
        scene.environment.kind = kind;
        PackedScene packed = pack_scene(scene, path_settings());
        const float lamp = packed.punctual_lights[0].pmf;
        for (const float scale : {0.5F, 3.0F, 0.01F}) {
            scene.environment.scale = glm::vec3(scale);
            scene.environment.rotation += 1.25;
            pack_moment(scene, path_settings(), packed);
            check_same(packed, pack_scene(scene, path_settings()));
            CHECK((packed.punctual_lights[0].pmf > lamp) == (scale < 1));
        }
    }
}

TEST_CASE("an environment of another tint, or one that was dark, is refused as a moment") {
    Scene scene = mapped_scene();
    scene.environment.scale = {1, 0.5F, 0.25F};
    PackedScene packed = pack_scene(scene, path_settings());
    scene.environment.scale *= 3.0F;
    pack_moment(scene, path_settings(), packed);
    scene.environment.scale = {1, 1, 0.25F};
    CHECK_THROWS_WITH(pack_moment(scene, path_settings(), packed), Catch::Contains("tint"));
    scene.environment.scale = {0, 0, 0};
    CHECK_THROWS_WITH(pack_moment(scene, path_settings(), packed), Catch::Contains("tint"));
}

TEST_CASE("settings that no array depends on are taken over as if packed anew") {
    Scene scene = mapped_scene();
    RenderSettings settings = path_settings();
    PackedScene packed = pack_scene(scene, settings);
    settings.integrator = Integrator::restir;
    settings.moves = true;
    settings.width = 12;
    settings.max_depth = 3;
    settings.seed = 9;
    settings.brdf = BrdfModel::blinn_phong;
    settings.standard_error = true;
    REQUIRE(repack_settings(scene, settings, packed));
    check_same(packed, pack_scene(scene, settings));
    CHECK(packed.keeps_previous);
    CHECK(!packed.previous_instances.empty());
    settings.integrator = Integrator::direct;
    settings.moves = false;
    scene.cameras[0].lens.radius = 0.5;
    REQUIRE(repack_settings(scene, settings, packed));
    check_same(packed, pack_scene(scene, settings));
    CHECK(!packed.keeps_previous);
}

TEST_CASE("settings and scenes that other arrays go with want packing anew") {
    Scene scene = mapped_scene();
    RenderSettings settings = path_settings();
    PackedScene packed = pack_scene(scene, settings);
    const PackedScene before = packed;
    settings.integrator = Integrator::brdf;  // which needs no tables of lights
    CHECK(!repack_settings(scene, settings, packed));
    settings.integrator = Integrator::path;
    settings.generic = true;  // which has all texture coordinates
    CHECK(!repack_settings(scene, settings, packed));
    settings.generic = false;
    scene.lights.emplace_back();
    CHECK(!repack_settings(scene, settings, packed));
    scene.lights.pop_back();
    scene.environment.scale = {0, 0, 0};
    CHECK(!repack_settings(scene, settings, packed));
    check_same(packed, before);
}

TEST_CASE("settings are taken over at any moment, which is then its own past") {
    Scene scene = generate_scene("moving-light").scene;
    RenderSettings settings = path_settings();
    settings.light_sampler = LightSampler::power;  // a light tree keeps the form that it has at rest
    PackedScene packed = pack_scene(scene, settings);
    pose_scene(scene, 1.5);
    settings.integrator = Integrator::restir;
    settings.moves = true;
    REQUIRE(repack_settings(scene, settings, packed));
    check_same(packed, pack_scene(scene, settings));
    CHECK(packed.constants.light_cluster_count >= 2);
    settings.integrator = Integrator::direct;
    settings.moves = false;
    REQUIRE(repack_settings(scene, settings, packed));
    check_same(packed, pack_scene(scene, settings));
    CHECK(packed.light_clusters.empty());
}
