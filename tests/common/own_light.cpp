// Which scenes light themselves, and which would come out black (docs/decisions/0018-the-default-sky.md).
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>

#include "catch.h"
#include "gltf_fixture.h"
#include "generate/generate.h"
#include "generate/shapes.h"
#include "gltf/import.h"
#include "scene/own_light.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// A level square around a point; its front looks up, or down.
Primitive level_square(const glm::vec3& centre, float half, int material, bool up = true) {
    Primitive out;
    out.material = material;
    const glm::vec3 x(half, 0, 0);
    const glm::vec3 z(0, 0, up ? half : -half);
    add_quad(out, centre - x + z, centre + x + z, centre + x - z, centre - x - z);
    return out;
}

/// A grey floor of 4 metres, seen from the front and above.
Scene floor_scene() {
    Scene scene;
    scene.name = "floor";
    add_object(scene, "floor",
               {level_square({0, 0, 0}, 2, add_material(scene, make_material("grey", glm::vec3(0.5F), 0, 1)))});
    scene.cameras.push_back(make_camera("camera", {0, 2, 6}, {0, 0, 0}, 45));
    return scene;
}

/// A square lamp of 0.4 metres, 1.5 metres above the floor.
int add_lamp(Scene& scene, float radiance) {
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(radiance)));
    add_object(scene, "lamp", {level_square({0, 1.5F, 0}, 0.2F, lamp, false)});
    return lamp;
}

}  // namespace

TEST_CASE("what lights a view is measured as the form factors say", "[own_light]") {
    // A unit square at height 1 over a point gives it E = 0.752275 L; a white sky of radiance 1 gives pi.
    const double share = 0.752275 / std::numbers::pi;
    Scene scene;
    add_object(scene, "point",
               {level_square({0, 0, 0}, 1e-3F, add_material(scene, make_material("grey", glm::vec3(0.5F), 0, 1)))});
    add_object(scene, "lamp",
               {level_square({0, 1, 0}, 0.5F, add_material(scene, make_emitter("lamp", glm::vec3(3))), false)});
    Camera camera = make_camera("camera", {0, 0.5, 0.001}, {0, 0, 0}, 0.1);
    const LightOfView light = light_of_view(scene, camera);
    CHECK(light.points > 400);
    CHECK(light.lamps == Approx(3 * share).epsilon(0.01));
    CHECK(light.brightness == Approx(3 * share).epsilon(0.01));
    CHECK(light.enclosure == Approx(share).epsilon(0.01));
    camera = make_camera("camera", {0, 0.5, 0.001}, {0, 1, 0}, 45);  // up at the lamp, which gives itself nothing
    CHECK(light_of_view(scene, camera).brightness == Approx(3).epsilon(1e-6));
    CHECK(light_of_view(scene, camera).lamps == 0);
}

TEST_CASE("a lamp lights a scene, and the same lamp as dim as paper does not", "[own_light]") {
    Scene scene = floor_scene();
    CHECK(own_light(scene) == OwnLight::absent);
    const auto lamp = static_cast<std::size_t>(add_lamp(scene, 1));
    CHECK(own_light(scene) == OwnLight::too_weak);
    scene.materials[lamp].emission = glm::vec3(1.5F);  // no factor of glTF's says that: it has a strength
    CHECK(own_light(scene) == OwnLight::enough);
    scene.materials[lamp].emission = glm::vec3(0, 0, 30);  // a blue one too, whose luminance is below 1
    CHECK(own_light(scene) == OwnLight::enough);
    scene.materials[lamp].emission = glm::vec3(0);
    CHECK(own_light(scene) == OwnLight::absent);
    add_lamp(scene, 0);
    scene.lights.emplace_back();
    CHECK(own_light(scene) == OwnLight::enough);
    scene.lights.clear();
    scene.environment.kind = EnvironmentKind::constant;
    CHECK(own_light(scene) == OwnLight::enough);
}

TEST_CASE("a lamp too small to light anything is no light, however bright", "[own_light]") {
    Scene scene = floor_scene();
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(20)));
    add_object(scene, "pilot lamp", {level_square({0, 1.5F, 0}, 1e-3F, lamp, false)});
    CHECK(own_light(scene) == OwnLight::too_weak);
    add_object(scene, "sign", {level_square({0, 1.5F, 0}, 0.1F, lamp, true)});  // shines at nothing
    CHECK(own_light(scene) == OwnLight::too_weak);
}

TEST_CASE("emission that glows all over the view or closes it in is light enough", "[own_light]") {
    Scene scene = floor_scene();
    scene.materials[0].emission = glm::vec3(0.5F);
    CHECK(own_light(scene) == OwnLight::enough);
    scene.materials[0].emission = glm::vec3(0.1F);
    CHECK(own_light(scene) == OwnLight::too_weak);
    // A dim box around the same floor, fronts inside.
    const int glow = add_material(scene, make_emitter("glow", glm::vec3(0.01F)));
    Primitive box;
    box.material = glow;
    add_box(box, glm::vec3(-10), glm::vec3(10));
    for (glm::uvec3& triangle : box.triangles) {
        std::swap(triangle.y, triangle.z);
    }
    add_object(scene, "box", {box});
    CHECK(own_light(scene) == OwnLight::enough);
}

TEST_CASE("a label's texture counts by what it emits where it is seen", "[own_light]") {
    Scene scene = floor_scene();
    // The right half of the floor's texture emits, and then nothing but one texel in a hundred.
    TextureImage image;
    image.width = 10;
    image.height = 10;
    for (int i = 0; i < 100; ++i) {
        const auto value = static_cast<std::uint8_t>(i % 10 >= 4 ? 255 : 0);
        image.rgba.insert(image.rgba.end(), {value, value, value, 255});
    }
    scene.images.push_back(image);
    scene.textures.emplace_back().image = 0;
    Primitive& floor = scene.meshes[0].primitives[0];
    floor.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    scene.materials[0].emission = glm::vec3(1);
    scene.materials[0].emission_texture.texture = 0;
    CHECK(own_light(scene) == OwnLight::enough);
    for (std::size_t i = 0; i < 100; ++i) {
        const auto value = static_cast<std::uint8_t>(i == 55 ? 255 : 0);
        scene.images[0].rgba[4 * i] = scene.images[0].rgba[4 * i + 1] = scene.images[0].rgba[4 * i + 2] = value;
    }
    CHECK(own_light(scene) == OwnLight::too_weak);
}

TEST_CASE("unlit surfaces need no light and are none", "[own_light]") {
    Scene scene = floor_scene();
    Material poster = make_material("poster", glm::vec3(1), 0, 1);
    poster.unlit = true;
    const int unlit = add_material(scene, poster);
    add_object(scene, "poster", {level_square({0, 1, 0}, 0.3F, unlit)});
    CHECK(own_light(scene) == OwnLight::too_weak);
    scene.meshes[0].primitives[0].material = unlit;
    CHECK(own_light(scene) == OwnLight::enough);
}

TEST_CASE("a lamp that is dark at rest is a light where its animation switches it on", "[own_light]") {
    Scene scene = floor_scene();
    const int lamp = add_lamp(scene, 0);
    scene.materials[static_cast<std::size_t>(lamp)].moving_emission = MovingEmission{glm::vec3(1), 0};
    CHECK(own_light(scene) == OwnLight::absent);
    Channel channel;
    channel.property = AnimatedProperty::emissive_strength;
    channel.target = lamp;
    channel.times = {0, 1, 2};
    channel.values = {0, 8, 0};
    scene.animations.emplace_back().channels.push_back(channel);
    CHECK(own_light(scene) == OwnLight::enough);
}

TEST_CASE("the decision depends on the scene's own cameras, and one that sees nothing is passed over", "[own_light]") {
    Scene scene = floor_scene();
    add_lamp(scene, 10);
    scene.cameras[0] = make_camera("away", {0, 2, 6}, {0, 2, 12}, 45);
    CHECK(own_light(scene) == OwnLight::enough);
    scene.cameras.clear();
    CHECK(own_light(scene) == OwnLight::enough);
}

TEST_CASE("all scenes of the project that emit light themselves", "[own_light]") {
    // A millimetre above two metres of floor there is a lamp of radiance 1 that lights nothing in sight.
    const std::map<std::string, OwnLight> others{{"extreme-near-lamp", OwnLight::too_weak}};
    const auto check = [&](const SceneGenerator& generator) {
        INFO(generator.name);
        const GeneratedScene generated = generator.generate({});
        const auto other = others.find(generator.name);
        CHECK(own_light(generated.scene) == (other == others.end() ? OwnLight::enough : other->second));
        // What needs another sky than the default says so.
        CHECK((other == others.end() || !generated.recommended.environment.empty()));
    };
    for (const SceneGenerator& generator : scene_generators()) {
        check(generator);
    }
    for (const SceneGenerator& generator : extreme_scene_generators()) {
        check(generator);
    }
}

TEST_CASE("real assets with labels and lamps", "[own_light]") {
    const std::filesystem::path folder = asset_folder();
    if (!std::filesystem::exists(folder / "gltf")) {
        SKIP_TEST("no assets at " + folder.string());
    }
    const std::map<std::string, OwnLight> expected{
        {"gltf/khronos/WaterBottle/WaterBottle.gltf", OwnLight::too_weak},
        {"gltf/khronos/ClearCoatTest/ClearCoatTest.glb", OwnLight::too_weak},
        {"gltf/khronos/MultiUVTest/MultiUVTest.gltf", OwnLight::too_weak},
        {"gltf/khronos/ToyCar/ToyCar.gltf", OwnLight::too_weak},
        {"gltf/khronos/TransmissionTest/TransmissionTest.glb", OwnLight::too_weak},
        {"gltf/khronos/TextureEncodingTest/TextureEncodingTest.gltf", OwnLight::too_weak},
        {"gltf/usd_shader_ball/usd-shaderball-ball.glb", OwnLight::too_weak},
        {"asset-generator/Material/Material_06.gltf", OwnLight::too_weak},
        {"asset-generator/Material/Material_03.gltf", OwnLight::enough},
        {"gltf/khronos/EmissiveStrengthTest/EmissiveStrengthTest.gltf", OwnLight::enough},
        {"gltf/khronos/UnlitTest/UnlitTest.gltf", OwnLight::enough},
        {"gltf/cornell_mm/cornell_mm.gltf", OwnLight::enough},
        {"gltf/bistro/bistro_interior.gltf", OwnLight::enough},
        {"gltf/khronos/Duck/glTF/Duck.gltf", OwnLight::absent},
    };
    for (const auto& [file, light] : expected) {
        INFO(file);
        CHECK(own_light(load_gltf(folder / file)) == light);
    }
}
