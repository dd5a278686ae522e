// An edited scene renders as a scene that was so from the start, on every backend and in a session that was open
// before.
#include <functional>

#include "library/library_fixture.h"

using namespace library_tests;

namespace {

struct Edit {
    const char* name;
    std::function<void(dp::Scene&)> make;
};

const std::vector<Edit> edits = {
    {"roughness", [](dp::Scene& s) { s.material("white").roughness = 0.2F; }},
    {"color",
     [](dp::Scene& s) {
         s.material("red").base_color = {0.1F, 0.7F, 0.1F, 1};
     }},
    {"a brighter lamp",
     [](dp::Scene& s) {
         s.material("lamp").emission = {40, 40, 40};
     }},
    {"a lamp goes out",
     [](dp::Scene& s) {
         s.material("lamp").emission = {0, 0, 0};
     }},
    {"a wall emits",
     [](dp::Scene& s) {
         s.material("red").emission = {1, 0.2F, 0.2F};
     }},
    {"both sides", [](dp::Scene& s) { s.material("lamp").double_sided = true; }},
    {"glass of alpha",
     [](dp::Scene& s) {
         s.material("red").alpha_mode = dp::AlphaMode::blend;
         s.material("red").base_color[3] = 0.4F;
     }},
    {"a sun",
     [](dp::Scene& s) {
         s.add(dp::Sun{30, 40, 3});
     }},
    {"a spot",
     [](dp::Scene& s) {
         dp::Light light;
         light.kind = dp::LightKind::spot;
         light.light_to_world = dp::look_at({0, 1.8, 1}, {0, 0, 0}).camera_to_world;
         light.intensity = {5, 5, 5};
         s.lights().push_back(light);
     }},
    {"a sky",
     [](dp::Scene& s) {
         s.environment().scale = {0.3F, 0.4F, 0.5F};
     }},
    {"a map",
     [](dp::Scene& s) {
         auto map = std::make_shared<dp::EnvironmentMap>();
         map->width = 4;
         map->height = 2;
         map->texels.assign(8, {0.1F, 0.1F, 0.1F});
         map->texels[2] = {4, 3, 2};
         s.environment() = {{1, 1, 1}, 0.5, map};
     }},
    {"another camera",
     [](dp::Scene& s) {
         s.camera("front") = dp::look_at({1, 1, 3}, {0, 0.5, 0});
     }},
    {"a wall moves", [](dp::Scene& s) { s.instance("wall").object_to_world[14] = 0.7; }},
    {"a wall goes", [](dp::Scene& s) { s.instances().erase(s.instances().begin() + 1); }},
    {"a mesh comes",
     [](dp::Scene& s) {
         const std::vector<dp::Vec3> corners = {{0, 0, 0}, {0.8F, 0, 0}, {0, 0.8F, 0}};
         const std::vector<std::array<std::uint32_t, 3>> triangle = {{0, 1, 2}};
         dp::MeshData mesh;
         mesh.positions = corners;
         mesh.triangles = triangle;
         s.add_mesh(mesh);
     }},
    {"a texture",
     [](dp::Scene& s) {
         const std::vector<std::uint8_t> texels = {255, 255, 255, 255, 20, 20, 20, 255};
         s.material("white").base_color_texture.texture = s.add_texture(2, 1, texels);
     }},
};

void check_edits(dp::Integrator integrator, const std::vector<Edit>& chosen) {
    const dp::Settings settings = small_settings(integrator);
    for (const dp::Backend backend : panels()) {
        const dp::Film before = rendered(small_scene(), backend, settings, 2);
        for (const Edit& edit : chosen) {
            INFO(dp::name_of(backend) << " " << dp::name_of(integrator) << ": " << edit.name);
            dp::Scene built = small_scene();
            edit.make(built);
            const dp::Film expected = rendered(built, backend, settings, 2);
            CHECK_FALSE(same_bits(expected, before));

            dp::Scene scene = small_scene();
            dp::BackendChoice choice;
            choice.backend = backend;
            dp::Session session(scene, choice, settings);
            session.render(2);
            edit.make(scene);
            session.render(2);
            CHECK(same_bits(session.film(), expected));
            CHECK(session.film().info().spp == 2);
        }
    }
}

}  // namespace

TEST_CASE("A session renders an edited scene as a session that was opened after the edit") {
    check_edits(dp::Integrator::path, edits);
}

TEST_CASE("And so it does where reservoirs are reused") {
    std::vector<Edit> lights;  // of which its tables and its history are made
    for (const Edit& edit : edits) {
        const std::string name = edit.name;
        if (name == "a wall emits" || name == "a lamp goes out" || name == "a map") {
            lights.push_back(edit);
        }
    }
    check_edits(dp::Integrator::restir, lights);
}

TEST_CASE("Edits one after another, and of a scene that two sessions render") {
    dp::Scene scene = small_scene();
    dp::Session first(scene, {}, small_settings());
    dp::Session second(scene, {}, small_settings());
    first.render(1);
    for (const float roughness : {0.1F, 0.5F, 0.9F}) {
        scene.material("white").roughness = roughness;
        first.render(1);
        second.render(1);
        CHECK(same_bits(first.film(), second.film()));
        CHECK(same_bits(first.film(), rendered(scene.copy(), dp::Backend::cpu, small_settings(), 1)));
    }
}

TEST_CASE("A copy of a scene is a scene of its own, a copied handle is the same") {
    dp::Scene scene = small_scene();
    dp::Scene handle = scene;
    dp::Scene copy = scene.copy();
    scene.material("white").roughness = 0.25F;
    CHECK(handle.material("white").roughness == 0.25F);
    CHECK(copy.material("white").roughness == 1);
}

TEST_CASE("The oracle follows edits too") {
    dp::Scene scene = small_scene();
    dp::BackendChoice choice;
    choice.backend = dp::Backend::oracle;
    dp::Session session(scene, choice, small_settings());
    session.render(2);
    scene.material("lamp").emission = {40, 40, 40};
    session.render(2);
    CHECK(same_bits(session.film(), rendered(scene, dp::Backend::oracle, small_settings(), 2)));
}
