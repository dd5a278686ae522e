// Points on emissive triangles, many at a time.
#pragma once

#include "leaves.h"

namespace diptych::core {

/// sample_emitter_point's arguments and results, each an array over lanes: the shared code in a loop without branches,
/// which compilers turn into vectors. What one triangle costs, a vector of them costs too.
struct alignas(64) TriangleLanes {
    static constexpr int width = 16;
    using Lane = float[width];

    void put(int lane, const shared::EmissiveTriangle& light, const glm::vec3& reference, const glm::vec2& u) {
        const glm::vec3 to_vertex_0 = light.vertex_0 - reference;
        for (int axis = 0; axis < 3; ++axis) {
            a[axis][lane] = to_vertex_0[axis];
            e1[axis][lane] = light.edge_1[axis];
            e2[axis][lane] = light.edge_2[axis];
            normal[axis][lane] = light.front[axis];
        }
        double_area[lane] = light.double_area;
        u1[lane] = u.x;
        u2[lane] = u.y;
    }

    /// By solid angle; a lane whose triangle is to be sampled by area gets a pdf of 0.
    [[gnu::noinline]] void sample() {
        for (int i = 0; i < width; ++i) {
            const glm::vec3 edge_1(e1[0][i], e1[1][i], e1[2][i]);
            const glm::vec3 edge_2(e2[0][i], e2[1][i], e2[2][i]);
            const shared::TriangleView view =
                shared::triangle_view({a[0][i], a[1][i], a[2][i]}, edge_1, edge_2,
                                      {normal[0][i], normal[1][i], normal[2][i]}, double_area[i]);
            const float solid_angle = shared::view_solid_angle(view);
            const glm::vec2 b = shared::sample_spherical_triangle(view, solid_angle, {u1[i], u2[i]});
            b1[i] = b.x;
            b2[i] = b.y;
            pdf[i] = shared::samples_spherically(view) ? 1.0F / solid_angle : 0.0F;
        }
    }

    shared::TriangleSample get(int lane) const { return {{b1[lane], b2[lane]}, pdf[lane]}; }

private:
    Lane a[3]{};
    Lane e1[3]{};
    Lane e2[3]{};
    Lane normal[3]{};
    Lane double_area{};
    Lane u1{};
    Lane u2{};
    Lane b1{};
    Lane b2{};
    Lane pdf{};
};

}  // namespace diptych::core
