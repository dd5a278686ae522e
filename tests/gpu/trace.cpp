// What the pipelines meet, against a loop over all triangles in double precision.
#include "gpu_fixture.h"

#include <cmath>

#include <glm/glm.hpp>

namespace diptych::core::tests {
namespace {

struct Truth {
    shared::Hit hit;
    double t = 0;
    bool close = false;  // a near tie or a grazed edge, where single precision may decide otherwise
};

glm::dvec3 place(const shared::Instance& instance, const shared::vec3& p) {
    const glm::dvec4 h(p.x, p.y, p.z, 1.0);
    return {glm::dot(glm::dvec4(instance.row_0), h), glm::dot(glm::dvec4(instance.row_1), h),
            glm::dot(glm::dvec4(instance.row_2), h)};
}

// Möller and Trumbore 1997; `edge` is how far inside all three edges the hit lies.
bool intersect(const glm::dvec3 (&v)[3], const glm::dvec3& o, const glm::dvec3& d, double& t, glm::dvec2& b,
               double& edge) {
    const glm::dvec3 e1 = v[1] - v[0];
    const glm::dvec3 e2 = v[2] - v[0];
    const glm::dvec3 p = glm::cross(d, e2);
    const double determinant = glm::dot(e1, p);
    b.x = glm::dot(o - v[0], p) / determinant;
    const glm::dvec3 q = glm::cross(o - v[0], e1);
    b.y = glm::dot(d, q) / determinant;
    t = glm::dot(e2, q) / determinant;
    edge = std::min({b.x, b.y, 1.0 - b.x - b.y});
    return t > 0;
}

Truth brute_force(const PackedScene& packed, const shared::RecordedRay& ray) {
    Truth truth;
    truth.hit.instance = shared::NONE;
    truth.t = 1e30;
    for (std::uint32_t i = 0; i < packed.instances.size(); ++i) {
        const MeshRange& mesh = packed.meshes[packed.instance_meshes[i]];
        for (std::uint32_t g = 0; g < mesh.geometry_count; ++g) {
            const shared::Geometry& geometry = packed.geometries[mesh.first_geometry + g];
            for (std::uint32_t k = 0; k < packed.geometry_extents[mesh.first_geometry + g].triangle_count; ++k) {
                const shared::uvec3 triangle = packed.triangles[geometry.first_triangle + k];
                const glm::dvec3 v[3] = {
                    place(packed.instances[i], packed.positions[geometry.first_vertex + triangle.x]),
                    place(packed.instances[i], packed.positions[geometry.first_vertex + triangle.y]),
                    place(packed.instances[i], packed.positions[geometry.first_vertex + triangle.z])};
                double t = 0;
                double edge = 0;
                glm::dvec2 b(0);
                if (!intersect(v, ray.origin, ray.direction, t, b, edge) || edge < -1e-4) {
                    continue;
                }
                truth.close = truth.close || edge < 1e-4 || std::abs(t - truth.t) < 1e-4 ||
                              std::abs(t - ray.t_max) < 1e-4 || t < 1e-4;
                if (edge >= 0 && t < truth.t) {
                    truth.t = t;
                    truth.hit = {
                        .instance = i, .geometry = g, .primitive = k, .barycentrics = b, .t = static_cast<float>(t)};
                }
            }
        }
    }
    return truth;
}

}  // namespace

TEST_CASE("Builds in many small batches give the same hits as in one") {
    NEED_VULKAN();
    const PackedScene packed = random_scene(3, 17, 40, 9);
    const std::vector<shared::RecordedRay> rays = random_rays(4, 2000);
    const std::vector<TracedRay> one = trace_rays(packed, rays);
    const std::vector<TracedRay> many =
        trace_rays(packed, rays, {.structure_bytes = 1, .scratch_bytes = 1, .meshes = 1});
    int different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const bool same = one[i].hit.instance == many[i].hit.instance && one[i].blocked == many[i].blocked &&
                          (one[i].hit.instance == shared::NONE || one[i].hit.t == many[i].hit.t);
        different += same ? 0 : 1;
    }
    CHECK(different == 0);
    check_no_validation_messages();
}

TEST_CASE("A scene without instances, and a mesh without triangles, are traced as nothing") {
    NEED_VULKAN();
    PackedScene packed = random_scene(5, 1, 0, 2);
    const std::vector<shared::RecordedRay> rays = random_rays(6, 100);
    for (const TracedRay& ray : trace_rays(packed, rays)) {
        CHECK(ray.hit.instance == shared::NONE);
        CHECK_FALSE(ray.blocked);
    }
    packed.meshes.push_back(
        {.first_geometry = static_cast<std::uint32_t>(packed.geometries.size()), .geometry_count = 0});
    add_geometry(packed, {{0, 0, 0}}, {}, 0);
    add_instance(packed, 1, glm::mat4x3(1.0F));
    for (const TracedRay& ray : trace_rays(packed, rays)) {
        CHECK(ray.hit.instance == shared::NONE);
    }
    check_no_validation_messages();
}

TEST_CASE("Traced hits are those of a loop over all triangles") {
    NEED_VULKAN();
    const PackedScene packed = random_scene(1, 5, 23, 12);
    const std::vector<shared::RecordedRay> rays = random_rays(2, 4000);
    const std::vector<TracedRay> traced = trace_rays(packed, rays);
    int hits = 0;
    int blocked = 0;
    int wrong = 0;
    int skipped = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Truth truth = brute_force(packed, rays[i]);
        if (truth.close) {
            ++skipped;
            continue;
        }
        const shared::Hit& hit = traced[i].hit;
        bool same = hit.instance == truth.hit.instance && traced[i].blocked == (truth.t < rays[i].t_max);
        if (same && hit.instance != shared::NONE) {
            ++hits;
            same = hit.geometry == truth.hit.geometry && hit.primitive == truth.hit.primitive &&
                   std::abs(hit.t - truth.t) < 1e-4 * std::max(1.0, truth.t) &&
                   glm::length(hit.barycentrics - truth.hit.barycentrics) < 2e-3F;
        }
        blocked += traced[i].blocked ? 1 : 0;
        wrong += same ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(hits > 500);
    CHECK(blocked > 300);
    CHECK(skipped < 200);
    check_no_validation_messages();
}

}  // namespace diptych::core::tests
