// Triangles that lie exactly on others: the first of each kind stays.
#include "pack/duplicate_triangles.h"

#include "pack_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

Primitive one_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, int material = 0) {
    Primitive p;
    p.material = material;
    p.positions = {a, b, c};
    p.triangles = {{0, 1, 2}};
    return p;
}

const glm::vec3 v0(0, 0, 5);  // away from the eye at 0, about which triangles are cut
const glm::vec3 v1(1, 0, 5);
const glm::vec3 v2(0, 1, 5);

Scene scene_of(std::vector<Primitive> primitives) {
    Scene scene;
    scene.name = "twice";
    add_material(scene, make_material("matter", glm::vec3(0.5F), 0, 1));
    Material glass = make_material("glass", glm::vec3(0.5F), 0, 1);
    glass.alpha_mode = AlphaMode::blend;
    add_material(scene, glass);
    add_object(scene, "object", std::move(primitives));
    return scene;
}

std::size_t packed_triangles(const Scene& scene) {
    return pack_scene(scene, brdf_settings()).triangles.size();
}

}  // namespace

TEST_CASE("Exact duplicates within a mesh are left out, counted and reported") {
    const PackedScene packed =
        pack_scene(scene_of({one_triangle(v0, v1, v2), one_triangle(v1, v2, v0), one_triangle(v2, v0, v1)}),
                   brdf_settings());
    CHECK(packed.triangles.size() == 1);
    REQUIRE(packed.warnings.size() == 1);
    CHECK_THAT(packed.warnings[0], Catch::Contains("twice: 2 triangles repeat others"));
    Scene copies = scene_of({one_triangle(v0, v1, v2), one_triangle(v1, v2, v0)});
    add_instance(copies, "again", 0, translation(1, 0, 0));
    CHECK(find_duplicate_triangles(copies).count == 2);
    CHECK(packed_triangles(copies) == 1);
}

TEST_CASE("Duplicates are found whichever corner is named first, also where the least ones differ in one coordinate alone") {
    const glm::vec3 p(1, 2, 3);
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 q = p;
        q[axis] -= 0.5F;
        glm::vec3 r = p + glm::vec3(4, 5, 6);
        CAPTURE(axis);
        CHECK(packed_triangles(scene_of({one_triangle(p, q, r), one_triangle(q, r, p), one_triangle(r, p, q)})) == 1);
        r = p - glm::vec3(4, 5, 6);
        CHECK(packed_triangles(scene_of({one_triangle(p, q, r), one_triangle(q, r, p), one_triangle(r, p, q)})) == 1);
    }
}

TEST_CASE("What shows another side, lets rays pass or is an ulp aside is no duplicate") {
    CHECK(packed_triangles(scene_of({one_triangle(v0, v1, v2), one_triangle(v0, v2, v1)})) == 2);
    CHECK(packed_triangles(
              scene_of({one_triangle(v0, v1, v2, 1), one_triangle(v0, v1, v2, 1), one_triangle(v0, v1, v2)})) == 3);
    CHECK(packed_triangles(scene_of({one_triangle(v0, v1, v2), one_triangle(v0, v1, {0, 1.0000001F, 5})})) == 2);
}

TEST_CASE("Instances that stand in one place share their triangles, and moving ones do not") {
    Scene scene = scene_of({one_triangle(v0, v1, v2), one_triangle(v0, v1, v2, 1)});
    add_instance(scene, "again", 0);
    add_object(scene, "other", {one_triangle(v0, v2, v1), one_triangle(v1, v2, v0)});
    add_instance(scene, "elsewhere", 1, translation(0, 0, 1));
    const DuplicateTriangles found = find_duplicate_triangles(scene);
    CHECK(found.count == 2);
    const PackedScene packed = pack_scene(scene, brdf_settings());
    REQUIRE(packed.instances.size() == 4);
    std::vector<std::uint32_t> counts;
    for (const std::uint32_t mesh : packed.instance_meshes) {
        std::uint32_t count = 0;
        for (std::uint32_t g = 0; g < packed.meshes[mesh].geometry_count; ++g) {
            count += packed.geometry_extents[packed.meshes[mesh].first_geometry + g].triangle_count;
        }
        counts.push_back(count);
    }
    CHECK(counts == std::vector<std::uint32_t>{2, 1, 1, 2});
    for (Instance& instance : scene.instances) {
        instance.node = 0;
    }
    CHECK(find_duplicate_triangles(scene).count == 0);
    // All of the second is where the first is.
    Scene twice = scene_of({one_triangle(v0, v1, v2)});
    add_instance(twice, "again", 0);
    CHECK(pack_scene(twice, brdf_settings()).instances.size() == 1);
}
