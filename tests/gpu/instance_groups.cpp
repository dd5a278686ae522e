// Instances that stand still, built together.
#include "structures/instance_groups.h"

#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>

#include "error.h"
#include "gpu_fixture.h"
#include "render/film_statistics.h"
#include "renderer/path_renderer.h"
#include "generate/shapes.h"

namespace diptych::core::tests {
namespace {

/// random_scene, of which every fifth instance may move, or none.
PackedScene standing_scene(std::uint32_t meshes, std::uint32_t instances, std::uint32_t triangles, bool some_move) {
    PackedScene packed = random_scene(11, meshes, instances, triangles);
    for (std::uint32_t i = 0; i < instances; ++i) {
        packed.instance_moves.push_back(some_move && i % 5 == 0 ? 1 : 0);
    }
    return packed;
}

std::size_t count_grouped(const InstanceGroups& groups) {
    std::size_t count = 0;
    for (const InstanceGroup& group : groups.groups) {
        count += group.instances.size();
    }
    return count;
}

/// A closed sphere, stretched and turned, `distance` before the camera; and a triangle within it, so that there are two
/// to group.
Scene far_sphere(double distance) {
    Scene scene;
    scene.materials.emplace_back();
    scene.materials[0].metallic = 0;
    scene.meshes.resize(2);
    Primitive sphere = make_sphere(1.0F, 32, 17, 0);
    for (glm::vec3& p : sphere.positions) {
        p += glm::vec3(3, -2, 1);
    }
    Primitive inside;
    inside.positions = {{3, -2, 1}, {3.1F, -2, 1}, {3, -1.9F, 1}};
    inside.triangles = {{0, 1, 2}};
    inside.material = 0;
    scene.meshes[0].primitives = {sphere};
    scene.meshes[1].primitives = {inside};
    glm::dmat4 m = glm::translate(glm::dmat4(1), glm::dvec3(0.3, 0.2, -distance));
    m = glm::rotate(m, 0.7, glm::normalize(glm::dvec3(1, 2, 3)));
    m = glm::scale(m, glm::dvec3(1, 0.4, -1.7));
    m = glm::translate(m, glm::dvec3(-3, 2, -1));
    for (int mesh = 0; mesh < 2; ++mesh) {
        Instance instance;
        instance.mesh = mesh;
        instance.object_to_world = m;
        scene.instances.push_back(instance);
    }
    scene.cameras.emplace_back();
    scene.cameras[0].vertical_fov = 2 * std::atan(2 / distance);
    scene.environment.kind = EnvironmentKind::constant;
    return scene;
}

PathRendererOptions grouping() {
    PathRendererOptions options;
    options.grouping = Grouping::anywhere;
    return options;
}

}  // namespace

TEST_CASE("Instances are grouped where nothing moves or hides them, within the limits") {
    PackedScene packed = standing_scene(4, 20, 10, true);
    // Meshes of 1, 2, 3 and 1 geometries of 10 triangles, five instances each; 0, 5, 10 and 15 may move.
    InstanceGroups groups = group_instances(packed);
    REQUIRE(groups.groups.size() == 1);
    CHECK(count_grouped(groups) == 16);
    CHECK_FALSE(is_grouped(groups, 5));
    CHECK(is_grouped(groups, 6));
    CHECK(groups.groups[0].instances.front() == 1);
    CHECK(groups.geometries[0] == shared::uvec2(1, 0));
    CHECK(groups.geometries[1] == shared::uvec2(1, 1));
    CHECK(groups.geometries[2] == shared::uvec2(2, 0));

    packed.instance_shown.assign(20, 1);
    packed.instance_shown[6] = 0;
    CHECK(count_grouped(group_instances(packed)) == 15);

    // All meshes together have 70 triangles, so 70 copies are always let: the 40 of mesh 0, and then none.
    packed.instance_shown.clear();
    groups = group_instances(packed, {.copied_triangles = 0});
    CHECK(count_grouped(groups) == 4);
    CHECK(is_grouped(groups, 4));
    CHECK_FALSE(is_grouped(groups, 1));

    groups = group_instances(packed, {.triangles = 100});
    CHECK(count_grouped(groups) == 16);
    CHECK(groups.groups.size() == 3);
    CHECK(groups.groups[1].first_entry == 10);
    CHECK(group_instances(packed, {.triangles = 5}).groups.empty());

    CHECK(group_instances(random_scene(11, 4, 20, 10)).groups.empty());
    CHECK(group_instances(standing_scene(1, 1, 10, false)).groups.empty());
}

TEST_CASE("Grouped instances are hit as they are alone") {
    NEED_VULKAN();
    const bool some_move = GENERATE(false, true);
    const PackedScene packed = standing_scene(5, 23, 12, some_move);
    const std::vector<shared::RecordedRay> rays = random_rays(12, 4000);
    const std::vector<TracedRay> alone = trace_rays(packed, rays);
    for (const std::uint64_t triangles : {std::uint64_t{1} << 22U, std::uint64_t{100}}) {
        const InstanceGroups groups = group_instances(packed, {.triangles = triangles});
        CHECK((groups.groups.size() > 1) == (triangles == 100));
        const std::vector<TracedRay> grouped = trace_rays(packed, rays, {}, groups);
        int hits = 0;
        int different = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const shared::Hit& a = alone[i].hit;
            const shared::Hit& b = grouped[i].hit;
            bool same = a.instance == b.instance && alone[i].blocked == grouped[i].blocked;
            if (same && a.instance != shared::NONE) {
                ++hits;
                same = a.geometry == b.geometry && a.primitive == b.primitive &&
                       std::abs(a.t - b.t) < 1e-4F * std::max(1.0F, a.t) &&
                       glm::length(a.barycentrics - b.barycentrics) < 2e-3F;
            }
            different += same ? 0 : 1;
        }
        CAPTURE(triangles, some_move, hits);
        CHECK(hits > 500);
        CHECK(different <= 4);  // grazed edges, which either may miss
    }
    check_no_validation_messages();
}

TEST_CASE("What leaves a grouped surface does not meet it again") {
    NEED_VULKAN();
    for (const double distance : {3.0, 100.0, 1e4}) {
        RenderSettings settings;
        settings.width = 64;
        settings.height = 64;
        settings.integrator = Integrator::brdf;
        settings.max_depth = 4;
        const PackedScene packed = pack_scene(far_sphere(distance), settings);
        REQUIRE(group_instances(packed).groups.size() == 1);
        PathRenderer renderer(packed, test_options(), grouping());
        std::vector<shared::PathQuery> queries;
        for (std::uint32_t i = 0; i < 64 * 64 * 8; ++i) {
            queries.push_back({{i % 64, i / 64 % 64}, i / 4096});
        }
        int hits = 0;
        int again = 0;
        for (const shared::PathSummary& path : renderer.summarize_paths(queries)) {
            hits += path.vertices == 2 ? 1 : 0;
            again += path.vertices > 2 ? 1 : 0;
        }
        CAPTURE(distance);
        CHECK(hits > 3000);
        CHECK(again == 0);
    }
    check_no_validation_messages();
}

TEST_CASE("A grouped instance may not move") {
    NEED_VULKAN();
    RenderSettings settings;
    settings.width = 8;
    settings.height = 8;
    PackedScene packed = pack_scene(far_sphere(3), settings);
    PathRenderer renderer(packed, test_options(), grouping());
    renderer.move_to(packed);
    packed.instances[1].row_0.w += 1;
    packed.revisions = {};
    CHECK_THROWS_WITH(renderer.move_to(packed), Catch::Contains("instance 1 has moved"));
    check_no_validation_messages();
}

TEST_CASE("Groups are built anew where their scene is packed about another origin") {
    NEED_VULKAN();
    RenderSettings settings;
    settings.width = 16;
    settings.height = 16;
    settings.max_depth = 3;
    Scene scene = far_sphere(3);
    PathRenderer renderer(pack_scene(scene, settings), test_options(), grouping());
    scene.cameras[0].camera_to_world = glm::translate(glm::dmat4(1), glm::dvec3(0.5, 0.25, 0));
    const PackedScene aside = pack_scene(scene, settings);
    renderer.reconfigure(aside);
    PathRenderer fresh(aside, test_options(), grouping());
    const std::atomic<bool> cancel = false;
    renderer.render(0, 2, cancel);
    fresh.render(0, 2, cancel);
    const Film film = renderer.film();
    const Film expected = fresh.film();
    double sum = 0;
    for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
        CHECK(rounded(film.pixels[i].sum) == rounded(expected.pixels[i].sum));
        CHECK(film.pixels[i].rays == expected.pixels[i].rays);
        sum += rounded(expected.pixels[i].sum)[0];
    }
    CHECK(sum > 0);
    CHECK(renderer.costs().bytes == fresh.costs().bytes);
    check_no_validation_messages();
}

}  // namespace diptych::core::tests
