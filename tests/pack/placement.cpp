// Where packed things stand: moved to the camera, singular ones left out.
#include "pack_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

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

TEST_CASE("An instance under a matrix without a good inverse has vertices in the world") {
    Scene scene = least_scene();
    scene.meshes[0].primitives[0].normals.assign(4, glm::vec3(0, 1, 0));
    glm::dmat4 flat(2);
    flat[1] = {0, 0, 0, 0};
    flat[3] = {5, 6, 7, 1};
    add_instance(scene, "pancake", 0, flat);
    const PackedScene packed = pack_scene(scene, brdf_settings());
    CHECK(packed.warnings.empty());
    REQUIRE(packed.instances.size() == 2);
    REQUIRE(packed.geometries.size() == 2);
    CHECK(packed.instance_shown == std::vector<std::uint8_t>{1, 1});
    // About the middle of its box; the camera stands at (0, 1, 3).
    CHECK(packed.instances[1].row_0 == shared::vec4(1, 0, 0, 5));
    CHECK(packed.instances[1].row_1 == shared::vec4(0, 1, 0, 5));
    CHECK(packed.instances[1].row_2 == shared::vec4(0, 0, 1, 4));
    CHECK(packed.positions[packed.geometries[1].first_vertex] == shared::vec3(-2, 0, 2));
    // The cofactor matrix carries the normal of what was flattened along it; not normalised.
    CHECK(glm::normalize(packed.normals[packed.geometries[1].first_normal]) == shared::vec3(0, 1, 0));
    CHECK(packed.positions[packed.geometries[0].first_vertex] == shared::vec3(-1, 0, 1));
}

TEST_CASE("What a transform leaves no area or no size is left out, and counted once for each kind") {
    Scene scene = least_scene();
    glm::dmat4 line(1);
    line[0] = {0, 0, 0, 0};
    line[1] = {0, 0, 0, 0};
    add_instance(scene, "line", 0, line);
    add_instance(scene, "point", 0, glm::dmat4(glm::dmat3(0)));
    add_instance(scene, "speck", 0, glm::dmat4(glm::dmat3(1e-20)));
    add_instance(scene, "mite", 0, glm::dmat4(glm::dmat3(1e-8)));
    const PackedScene packed = pack_scene(scene, brdf_settings());
    CHECK(packed.instances.size() == 2);
    REQUIRE(packed.warnings.size() == 2);
    CHECK_THAT(packed.warnings[0], Catch::Contains("least: 2 instances are flattened"));
    CHECK_THAT(packed.warnings[1], Catch::Contains("least: 1 instances are too small"));
}

TEST_CASE("What is out of the range of single precision is refused by name") {
    const auto refused = [](const Scene& scene, const char* object, const char* reason) {
        CHECK_THROWS_WITH(pack_scene(scene, brdf_settings()),
                          Catch::Contains("least: ") && Catch::Contains(object) && Catch::Contains(reason));
    };
    for (const double far : {1e13, 1e30, 1e300, std::numeric_limits<double>::infinity()}) {
        Scene scene = least_scene();
        add_instance(scene, "beyond", 0, glm::dmat4(glm::dmat3(far)));
        refused(scene, "instance 'beyond'", "from the camera");
        scene = least_scene();
        scene.cameras[0].camera_to_world[3].x = far;
        refused(scene, "instance 'square'", "from the camera");
        scene = least_scene();
        scene.lights.emplace_back().name = "star";
        scene.lights[0].light_to_world[3].y = far;
        refused(scene, "light 'star'", "from the camera");
        scene = least_scene();
        scene.cameras[0].orthographic = true;
        scene.cameras[0].orthographic_height = far;
        refused(scene, "camera 'camera'", "half width");
        scene = least_scene();
        scene.cameras[0].lens.radius = far;
        refused(scene, "camera 'camera'", "lens");
    }
    Scene tiny = least_scene();
    tiny.instances[0].object_to_world = glm::dmat4(glm::dmat3(1e-20));
    CHECK(pack_scene(tiny, brdf_settings()).instances.empty());
    tiny.cameras[0].camera_to_world[3] = {0, 1e-20, 3e-20, 1};
    refused(tiny, "instance 'square'", "is 2.83e-20 m across");
}

TEST_CASE("Vertices of 1e30 under a matrix of 1e-30 are where they are") {
    Scene scene = least_scene();
    for (glm::vec3& p : scene.meshes[0].primitives[0].positions) {
        p *= 1e30F;
    }
    scene.instances[0].object_to_world = glm::dmat4(glm::dmat3(1e-30));
    const auto corner = [](const PackedScene& packed) {
        const shared::Instance& i = packed.instances.at(0);
        const glm::vec4 p(packed.positions[0], 1);
        return glm::vec3(glm::dot(i.row_0, p), glm::dot(i.row_1, p), glm::dot(i.row_2, p));
    };
    CHECK(glm::length(corner(pack_scene(scene, brdf_settings())) - glm::vec3(-1, -1, -2)) < 1e-6F);
    scene.instances[0].node = 0;
    scene.nodes.emplace_back();
    CHECK(glm::length(corner(pack_scene(scene, brdf_settings())) - glm::vec3(-1, -1, -2)) < 1e-6F);
}

TEST_CASE("Meshes are kept once, whatever the number of their instances") {
    Scene scene = least_scene();
    for (int i = 0; i < 100; ++i) {
        add_instance(scene, "copy", 0, translation(i + 1, 0, 0));
    }
    const PackedScene packed = pack_scene(scene, brdf_settings());
    CHECK(packed.instances.size() == 101);
    CHECK(packed.triangles.size() == 2);
    CHECK(packed.geometries.size() == 1);
    CHECK(packed.meshes.size() == 1);
}

TEST_CASE("A mesh's spread is that of its longest, middle and shortest axis, however they lie") {
    // An octahedron, each corner of which is in four triangles, so that its principal axes are its own.
    const glm::dvec3 half(3, 0.5, 0.1);
    const glm::dmat3 turned(glm::normalize(glm::dvec3(2, 1, 2)), glm::normalize(glm::dvec3(-2, 2, 1)), glm::normalize(glm::dvec3(-1, -2, 2)));
    const glm::dvec3 middle(0.7, -0.4, 0.2);
    Primitive p;
    for (int axis = 0; axis < 3; ++axis) {
        p.positions.emplace_back(middle + turned[axis] * half[axis]);
        p.positions.emplace_back(middle - turned[axis] * half[axis]);
    }
    for (unsigned corner = 0; corner < 8; ++corner) {
        p.triangles.emplace_back(corner & 1U, 2 + (corner >> 1U & 1U), 4 + (corner >> 2U));
    }
    Scene scene = least_scene();
    p.material = 0;
    scene.meshes.clear();
    scene.instances.clear();
    add_object(scene, "octahedron", {p});
    scene.nodes.emplace_back();  // that may flatten it at some moment
    scene.instances[0].node = 0;
    const PackedScene packed = pack_scene(scene, brdf_settings());
    const MeshFrame& frame = packed.mesh_frames.at(0);
    CHECK(glm::length(frame.center + frame.unit * frame.middle - middle) < 1e-6);
    CHECK(glm::length(frame.unit * frame.spread.half - half) < 1e-6);
    for (int axis = 0; axis < 3; ++axis) {
        CHECK(std::abs(glm::dot(frame.spread.axes[axis], turned[axis])) == Approx(1).epsilon(1e-6));
    }
    CHECK(glm::determinant(frame.spread.axes) == Approx(1));
}

TEST_CASE("A mesh's unit is a power of two near its own size, wherever it lies, and 1 for what is neither tiny nor huge") {
    const auto frame_of = [](const glm::vec3& center, float half, const glm::dmat4& to_world) {
        Scene scene = least_scene();
        for (glm::vec3& p : scene.meshes[0].primitives[0].positions) {
            p = center + half * p;
        }
        scene.instances[0].object_to_world = to_world;
        return pack_scene(scene, brdf_settings()).mesh_frames.at(0);
    };
    const MeshFrame away = frame_of({1e8F, 0, 0}, 128, translation(-1e8, 0, 0));
    CHECK(away.unit == 1);
    CHECK(glm::length(away.center - glm::dvec3(1e8, 0, 0)) < 16);
    const MeshFrame tiny = frame_of({0, 0, 0}, 0x1p-27F, glm::dmat4(glm::dmat3(0x1p27)));
    CHECK(tiny.unit == 0x1p-27);
    CHECK(tiny.center == glm::dvec3(0));
}

TEST_CASE("The camera's film has the render's aspect") {
    Scene scene = least_scene();
    scene.cameras[0].vertical_fov = 2 * std::atan(0.5);
    RenderSettings settings = brdf_settings();
    settings.width = 300;
    settings.height = 100;
    const shared::Camera c = pack_scene(scene, settings).constants.camera;
    CHECK(c.kind == shared::CAMERA_PERSPECTIVE);
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
