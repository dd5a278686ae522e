// What a program may get wrong: one line that names the object, and nothing changed.
#include <fstream>
#include <functional>
#include <limits>

#include "library/library_fixture.h"

using namespace library_tests;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

struct Fault {
    std::function<void(dp::Scene&)> make;
    const char* message;
};

const std::vector<Fault> faults = {
    {[](dp::Scene& s) { s.material("red").roughness = 2; },
     "materials[1] 'red': roughness is 2; it has to be between 0 and 1"},
    {[](dp::Scene& s) { s.material("red").base_color[1] = not_a_number; },
     "materials[1] 'red': base_color is nan; it has to be finite and not negative"},
    {[](dp::Scene& s) { s.material("lamp").emission[0] = -1; },
     "materials[2] 'lamp': emission is -1; it has to be finite and not negative"},
    {[](dp::Scene& s) { s.material("red").ior = 0.5F; },
     "materials[1] 'red': ior is 0.5; it has to be 0, or finite and at least 1"},
    {[](dp::Scene& s) { s.material("red").base_color_texture.texture = 3; },
     "materials[1] 'red': base_color_texture is 3; it has to be below the number of textures, 0"},
    {[](dp::Scene& s) { s.materials().pop_back(); },
     "materials: 1 of the scene's 3 are gone; other parts of the scene refer to them by index"},
    {[](dp::Scene& s) { s.camera("front").vertical_fov = 4; },
     "cameras[0] 'front': vertical_fov is 4; it has to be between 0 and pi"},
    {[](dp::Scene& s) { s.camera("front").camera_to_world[0] = 2; },
     "cameras[0] 'front': camera_to_world has to be rigid: a rotation and a translation"},
    {[](dp::Scene& s) { s.camera("front").focus_distance = 0; },
     "cameras[0] 'front': focus_distance is 0; it has to be finite and positive"},
    {[](dp::Scene& s) {
         dp::Light light;
         light.kind = dp::LightKind::spot;
         light.inner_cone = 1;
         s.lights().push_back(light);
     },
     "lights[0]: inner_cone is 1; it has to be at least 0 and below outer_cone"},
    {[](dp::Scene& s) { s.instance("wall").mesh = 7; },
     "instances[1] 'wall': mesh is 7; it has to be an index below the number of meshes, 3"},
    {[](dp::Scene& s) { s.environment().scale[2] = not_a_number; },
     "environment: scale is nan; it has to be finite and not negative"},
    {[](dp::Scene& s) {
         auto map = std::make_shared<dp::EnvironmentMap>();
         map->width = 4;
         map->height = 2;
         s.environment() = {{1, 1, 1}, 0, map};
     },
     "environment: the map has 0 texels; its size is 4x2"},
};

}  // namespace

TEST_CASE("An edit out of range is refused at the next render, by name, and can be taken back") {
    const dp::Film expected = rendered(small_scene(), dp::Backend::cpu, small_settings(), 1);
    for (const Fault& fault : faults) {
        dp::Scene scene = small_scene();
        dp::Session session(scene, {}, small_settings());
        session.render(1);
        const auto before_materials = scene.materials();
        const auto before_cameras = scene.cameras();
        const auto before_instances = scene.instances();
        fault.make(scene);
        CHECK(message_of([&] { session.render(1); }) == fault.message);
        CHECK(message_of([&] { dp::Session(scene, {}, small_settings()); }) == fault.message);
        CHECK(same_bits(session.film(), expected));
        scene.materials() = before_materials;
        scene.cameras() = before_cameras;
        scene.instances() = before_instances;
        scene.lights().clear();
        scene.environment() = {};
        session.restart();
        session.render(1);
        CHECK(same_bits(session.film(), expected));
    }
}

TEST_CASE("A mesh of arrays that do not fit is refused, and nothing is added") {
    const std::vector<dp::Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<dp::Vec3> two = {{0, 0, 1}, {0, 0, 1}};
    const std::vector<dp::Vec3> broken = {{0, 0, 0}, {1, not_a_number, 0}, {0, 1, 0}};
    const std::vector<std::array<std::uint32_t, 3>> triangle = {{0, 1, 2}};
    const std::vector<std::array<std::uint32_t, 3>> outside = {{0, 1, 3}};
    dp::MeshData mesh;
    mesh.name = "leaf";
    dp::Scene scene = small_scene();
    const auto message = [&](const auto& change) {
        dp::MeshData wrong = mesh;
        wrong.positions = corners;
        wrong.triangles = triangle;
        change(wrong);
        return message_of([&] { scene.add_mesh(wrong); });
    };
    CHECK(message([&](dp::MeshData& m) { m.positions = {}; }) == "mesh 'leaf': no positions");
    CHECK(message([&](dp::MeshData& m) { m.triangles = {}; }) == "mesh 'leaf': no triangles");
    CHECK(message([&](dp::MeshData& m) { m.normals = two; }) == "mesh 'leaf': 2 normals for 3 positions");
    CHECK(message([&](dp::MeshData& m) { m.positions = broken; }) == "mesh 'leaf': positions[1] is not finite");
    CHECK(message([&](dp::MeshData& m) { m.triangles = outside; }) ==
          "mesh 'leaf': triangles[0] names position 3; there are 3");
    CHECK(message([&](dp::MeshData& m) { m.material = 5; }) == "mesh 'leaf': material 5 of 3");
    CHECK(scene.mesh_count() == 3);
    CHECK(scene.instances().size() == 3);
    const std::vector<std::uint8_t> pixel(4, 255);
    CHECK(message_of([&] { scene.add_texture(2, 1, pixel, "wood"); }) == "texture 'wood': 4 bytes for 2x1 RGBA pixels");
}

TEST_CASE("A file reads and allocates what its caller allows") {
    const Folder folder;
    std::filesystem::create_directory(folder.path / "scene");
    std::filesystem::copy_file(source_dir + "/scenes/cornell.gltf", folder.path / "scene/cornell.gltf");
    std::filesystem::copy_file(source_dir + "/scenes/cornell.bin", folder.path / "cornell.bin");
    std::filesystem::create_symlink("../cornell.bin", folder.path / "scene/cornell.bin");
    const std::string file = folder.file("scene/cornell.gltf");
    dp::LoadOptions options;
    CHECK_THAT(message_of([&] { dp::load(file, options); }),
               Catch::Contains(file) && Catch::Contains("`allow_external`"));
    options.allow_external = true;
    CHECK(dp::load(file, options).mesh_count() > 0);
    options.memory_limit = 100;
    CHECK_THAT(message_of([&] { dp::load(file, options); }),
               Catch::Contains(file) && Catch::Contains("may ask for 100 bytes (`memory_limit`)"));
    const std::string sky = folder.file("sky.hdr");
    std::ofstream(sky) << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" << std::string(8, '\x80');
    CHECK(dp::load_environment(sky).map->width == 2);
    CHECK_THAT(message_of([&] { dp::load_environment(sky, 70); }),
               Catch::Contains(sky) && Catch::Contains("`memory_limit`"));
}

TEST_CASE("Names that a scene lacks, files that are not there and settings out of range are named") {
    dp::Scene scene = small_scene();
    CHECK(message_of([&] { scene.material("wite"); }) ==
          "scene: no material 'wite' (did you mean 'white'?); there are 'white', 'red', 'lamp'");
    CHECK_THAT(message_of([] { dp::load("nowhere.glb"); }), Catch::Contains("nowhere.glb"));
    CHECK_THAT(message_of([] { dp::backend_from("vulcan"); }), Catch::Contains("'vulcan'"));
    CHECK_THAT(message_of([] { dp::integrator_from("pat"); }), Catch::Contains("pat"));
    const auto refusal = [&](const std::function<void(dp::Settings&)>& change) {
        dp::Settings settings = small_settings();
        change(settings);
        return message_of([&] { dp::Session(scene, {}, settings); });
    };
    CHECK_THAT(refusal([](dp::Settings& s) { s.size = {0, 8}; }), Catch::Contains("size is 0"));
    CHECK_THAT(refusal([](dp::Settings& s) { s.camera = 1; }), Catch::Contains("camera is 1"));
    CHECK_THAT(refusal([](dp::Settings& s) { s.max_depth = 70000; }), Catch::Contains("max_depth is 70000"));
    CHECK_THAT(refusal([](dp::Settings& s) { s.resampling.neighbors = 9; }),
               Catch::Contains("resampling.neighbors is 9"));
    const auto refused = [&](const dp::BackendChoice& choice) {
        return message_of([&] { dp::Session(scene, choice, small_settings()); });
    };
    dp::BackendChoice choice;
    choice.device = "0";
    CHECK(refused(choice) == "backend cpu: device and validation are vulkan's");
    choice = {};
    choice.threads = -1;
    CHECK(refused(choice) == "backend: threads is -1; 0 is one a core");
    choice.backend = dp::Backend::vulkan;
    CHECK(refused(choice) == "backend vulkan: threads are those of cpu and oracle");
    CHECK_THROWS_AS(dp::Session(scene).render(0), dp::SettingError);
    CHECK_THROWS_AS(dp::backend_from("vulcan"), dp::SettingError);
    CHECK_THAT(message_of([] { dp::look_at({1, 1, 1}, {1, 1, 1}); }), !Catch::Contains("--"));
}

TEST_CASE("A picture larger than any device is refused as out of memory, with the size that would fit") {
    if (dp::devices().empty()) {
        SKIP_TEST("no Vulkan device with ray tracing; mesa-vulkan-drivers 24.3 or later brings one");
    }
    const dp::Scene scene = small_scene();
    dp::Settings settings = small_settings();
    settings.size = {65536, 65536};
    try {
        const dp::Session session(scene, dp::BackendChoice{.backend = dp::Backend::vulkan, .device = "", .threads = 0, .validation = false}, settings);
        FAIL("nothing was thrown");
    } catch (const dp::OutOfMemory& error) {
        CHECK_THAT(error.what(), Catch::Contains("out of memory: ") && Catch::Contains(" at once: the film ") &&
                                     Catch::Contains("a `size` of ") && Catch::Contains(" would fit"));
    }
}
