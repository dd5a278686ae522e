// Where packed things stand: moved to the camera, singular ones left out.
#include "pack_fixture.h"

using namespace diptych;
using namespace diptych::tests;

TEST_CASE("The camera is the origin, and far scenes keep their digits") {
    Scene near = least_scene();
    near.lights.emplace_back();
    near.lights[0].light_to_world = translation(0.125, 2.5, -0.75);
    Scene far = near;
    const glm::dvec3 shift(148376.1, 1234.7, -223423.3);
    const auto move = [&](glm::dmat4& m) { m[3] += glm::dvec4(shift, 0); };
    move(far.cameras[0].camera_to_world);
    move(far.instances[0].object_to_world);
    move(far.lights[0].light_to_world);
    const PackedScene a = pack_scene(near, brdf_settings());
    const PackedScene b = pack_scene(far, brdf_settings());
    CHECK(a.constants.camera.origin == shared::vec3(0));
    CHECK(b.constants.camera.origin == shared::vec3(0));
    // World coordinates in double are good to 3e-11 there.
    const auto close = [](const shared::vec4& p, const shared::vec4& q) { return glm::length(p - q) < 1e-6F; };
    CHECK(close(a.instances[0].row_0, b.instances[0].row_0));
    CHECK(close(a.instances[0].row_1, b.instances[0].row_1));
    CHECK(close(a.instances[0].row_2, b.instances[0].row_2));
    CHECK(a.instances[0].row_1.w == -1);
    CHECK(a.instances[0].row_2.w == -3);
    CHECK(glm::length(a.punctual_lights[0].position - b.punctual_lights[0].position) < 1e-6F);
    CHECK(glm::length(a.punctual_lights[0].position - shared::vec3(0.125F, 1.5F, -3.75F)) < 1e-6F);
}

TEST_CASE("An instance that is flattened to nothing is left out with a warning") {
    Scene scene = least_scene();
    glm::dmat4 flat(1);
    flat[1] = {0, 0, 0, 0};
    add_instance(scene, "pancake", 0, flat);
    glm::dmat4 tiny(1e-6);
    tiny[3] = {0, 0, 0, 1};
    add_instance(scene, "mite", 0, tiny);
    glm::dmat4 wrong(1);
    wrong[0][0] = std::numeric_limits<double>::infinity();
    add_instance(scene, "beyond", 0, wrong);
    const PackedScene packed = pack_scene(scene, brdf_settings());
    CHECK(packed.instances.size() == 2);
    CHECK(packed.instance_meshes.size() == 2);
    REQUIRE(packed.warnings.size() == 2);
    CHECK_THAT(packed.warnings[0], Catch::Contains("least") && Catch::Contains("pancake"));
    CHECK_THAT(packed.warnings[1], Catch::Contains("beyond"));
}

TEST_CASE("Meshes are kept once, whatever the number of their instances") {
    Scene scene = least_scene();
    for (int i = 0; i < 100; ++i) {
        add_instance(scene, "copy", 0, translation(i, 0, 0));
    }
    const PackedScene packed = pack_scene(scene, brdf_settings());
    CHECK(packed.instances.size() == 101);
    CHECK(packed.triangles.size() == 2);
    CHECK(packed.geometries.size() == 1);
    CHECK(packed.meshes.size() == 1);
}

TEST_CASE("The camera's film has the render's aspect") {
    Scene scene = least_scene();
    scene.cameras[0].vertical_fov = 2 * std::atan(0.5);
    RenderSettings settings = brdf_settings();
    settings.width = 300;
    settings.height = 100;
    const shared::Camera c = pack_scene(scene, settings).constants.camera;
    CHECK(glm::length(c.up) == Approx(0.5));
    CHECK(glm::length(c.right) == Approx(1.5));
    CHECK(glm::length(c.forward) == Approx(1));
    scene.cameras[0].orthographic = true;
    scene.cameras[0].orthographic_height = 4;
    const shared::Camera o = pack_scene(scene, settings).constants.camera;
    CHECK(glm::length(o.up) == Approx(2));
    CHECK(glm::length(o.right) == Approx(6));
    CHECK(o.kind == shared::CAMERA_ORTHOGRAPHIC);
}

TEST_CASE("Buffer bytes are those of the buffers") {
    const PackedScene packed = pack_scene(least_scene(), brdf_settings());
    // Four vertices and the padding one, two triangles, one geometry, one instance, one material.
    CHECK(buffer_bytes(packed) == 5 * 12 + 2 * 12 + 32 + 60 + 92);
}
