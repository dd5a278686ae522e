// What a surface gets from its triangle's corners, value by value: the second primitive of a mesh, whose corners all differ, under an
// instance that turns, stretches and moves, against double precision.
#include <limits>

#include "test_kernel.h"
#include "render_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

constexpr glm::dvec2 place(0.25, 0.4);  // barycentrics of the second and third corner

const glm::dmat4 placement(glm::dvec4(0.6, 0, -0.8, 0), glm::dvec4(0.3, 2, 0, 0), glm::dvec4(0.8, 0, 0.6, 0),
                           glm::dvec4(1, 2, 3, 1));

/// Corners with positions, normals, tangents, colours and coordinates that no two share.
Primitive leaning_triangle(int material) {
    Primitive p;
    p.material = material;
    p.positions = {{9, 9, 9}, {0, 0, 0}, {2, 0.5F, 0}, {0.3F, 0.2F, 1.5F}};
    p.normals = {{1, 0, 0}, {0.1F, 1, 0.2F}, {-0.4F, 1, 0.1F}, {0.2F, 1, -0.5F}};
    p.tangents = {{0, 1, 0, 1}, {1, 0.9F, 0, 1}, {1, 0.6F, 0.5F, 1}, {0.8F, 0.5F, 0.6F, 1}};
    p.colors = {{1, 1, 1, 1}, {0.9F, 0.1F, 0.2F, 1}, {0.2F, 0.8F, 0.3F, 1}, {0.1F, 0.4F, 0.7F, 1}};
    p.uvs[0] = {{0, 0}, {0.5F, 0.5F}, {0.5F, 0.5F}, {0.5F, 0.5F}};
    p.triangles = {{1, 3, 2}};  // faces +y
    for (glm::vec3& n : p.normals) {
        n = glm::normalize(n);
    }
    return p;
}

glm::dvec4 between(const Primitive& p, const std::vector<glm::vec4>& values) {
    const glm::uvec3 t = p.triangles[0];
    return (1 - place.x - place.y) * glm::dvec4(values[t.x]) + place.x * glm::dvec4(values[t.y]) + place.y * glm::dvec4(values[t.z]);
}

std::vector<glm::vec4> extended(const std::vector<glm::vec3>& values, float w) {
    std::vector<glm::vec4> all;
    for (const glm::vec3& v : values) {
        all.emplace_back(v, w);
    }
    return all;
}

struct CornerFixture {
    Scene scene;
    PackedScene packed;
    Primitive triangle;

    CornerFixture() {
        scene.name = "leaning";
        TextureImage texel;
        texel.width = 1;
        texel.height = 1;
        texel.rgba = {178, 89, 230, 255};
        scene.images.push_back(texel);
        Texture texture;
        texture.image = 0;
        scene.textures.push_back(texture);
        Material material = make_material("leaning", glm::vec3(0.5F), 0, 0.5F);
        material.normal_scale = 0.7F;
        material.normal_texture.texture = 0;
        add_material(scene, material);
        triangle = leaning_triangle(0);
        Primitive other = horizontal_square({5, 0, 0}, 1, true, 0);  // so that nothing of the triangle comes first
        other.normals.assign(other.positions.size(), glm::vec3(0, 1, 0));
        other.tangents.assign(other.positions.size(), glm::vec4(1, 0, 0, 1));
        other.colors.assign(other.positions.size(), glm::vec4(1));
        other.uvs[0].assign(other.positions.size(), glm::vec2(0));
        add_object(scene, "mesh", {other, triangle}, placement);
        scene.cameras.push_back(point_camera({0, 8, 9}, {1, 2, 3}));
        packed = pack_scene(scene, statistical_settings(4, 4, Integrator::path, 1));
    }
};

}  // namespace

TEST_CASE("A surface has its corners' positions, normals, tangents and colours in proportion to the barycentrics") {
    CornerFixture f;
    const EmbreeScene embree(f.packed);
    Kernel kernel{f.packed, f.packed.constants, {{embree}}};
    const glm::dvec3 origin = f.packed.origin;
    const auto world = [&](const glm::dvec4& v) { return glm::dvec3(placement * v) - (v.w > 0 ? origin : glm::dvec3(0)); };

    const glm::dvec3 position = world(between(f.triangle, extended(f.triangle.positions, 1)));
    const glm::dvec3 eye = glm::dvec3(0, 8, 9) - origin;
    const glm::vec3 direction(glm::normalize(position - eye));
    const shared::Hit hit = kernel.trace_closest(glm::vec3(eye), direction, 0);
    REQUIRE(hit.instance == 0);
    REQUIRE(hit.geometry == 1);
    const shared::Instance& instance = f.packed.instances[0];
    const Kernel::Surface s = kernel.load_surface(hit, instance, glm::vec3(eye), direction);
    CHECK(glm::length(glm::dvec3(s.position) - position) < 1e-5);

    const glm::dmat3 linear(placement);
    const glm::dvec3 n(between(f.triangle, extended(f.triangle.normals, 0)));
    const glm::dvec3 normal = glm::normalize(glm::inverse(glm::transpose(linear)) * n);
    CHECK(glm::length(glm::dvec3(kernel.interpolated_normal(s, instance)) - normal) < 1e-5);

    const glm::dvec4 color = between(f.triangle, f.triangle.colors);
    const shared::Material& material = f.packed.materials[s.mesh.geometry.material];
    CHECK(glm::length(glm::dvec3(kernel.base_color(material, s.mesh)) - 0.5 * glm::dvec3(color)) < 1e-5);

    const glm::dvec3 along = glm::normalize(linear * glm::dvec3(between(f.triangle, f.triangle.tangents)));
    REQUIRE(std::abs(glm::dot(along, normal)) > 0.1);  // so that it matters to take the normal's part off
    const glm::dvec3 tangent = glm::normalize(along - glm::dot(along, normal) * normal);
    const glm::dvec3 texel = glm::dvec3(178, 89, 230) / 255.0 * 2.0 - 1.0;
    const double scale = 0.7F;
    const glm::dvec3 mapped = glm::normalize(texel.x * scale * tangent + texel.y * scale * glm::cross(normal, tangent) + texel.z * normal);
    const glm::vec3 found = kernel.mapped_normal(s, instance, material, kernel.interpolated_normal(s, instance));
    CHECK(glm::length(glm::dvec3(found) - mapped) < 1e-5);

    // The same place a moment before, when the instance stood elsewhere.
    f.packed.features |= shared::FEATURE_MOTION;
    f.packed.previous_instances = f.packed.instances;
    f.packed.previous_instances[0].row_0.w += 3;
    f.packed.previous_instances[0].row_2.w -= 5;
    const glm::vec3 before = kernel.previous_position(s.position, hit);
    CHECK(glm::length(glm::dvec3(before) - position - glm::dvec3(3, 0, -5)) < 1e-5);
}

TEST_CASE("A surface's normals are unit and face the eye, from either side") {
    CornerFixture f;
    const EmbreeScene embree(f.packed);
    Kernel kernel{f.packed, f.packed.constants, {{embree}}};
    const glm::dvec3 position = glm::dvec3(placement * between(f.triangle, extended(f.triangle.positions, 1)));
    int faced = 0;
    for (const double side : {1.0, -1.0}) {
        const glm::dvec3 from = position + side * glm::dvec3(-1, 6, 6) - f.packed.origin;
        const glm::vec3 direction(glm::normalize(position - f.packed.origin - from));
        const shared::Hit hit = kernel.trace_closest(glm::vec3(from), direction, 0);
        REQUIRE(hit.geometry == 1);
        const Kernel::Surface s = kernel.load_surface(hit, f.packed.instances[0], glm::vec3(from), direction);
        const shared::SurfaceBsdf b = kernel.load_bsdf(s, f.packed.instances[0], f.packed.materials[0], -direction);
        CAPTURE(side);
        for (const glm::vec3& normal : {b.geometric_normal, b.shading_normal, b.mapped_normal}) {
            CHECK(glm::length(normal) == Approx(1).epsilon(1e-6));
        }
        CHECK(glm::dot(b.geometric_normal, -direction) > 0);
        CHECK(glm::dot(b.geometric_normal, b.shading_normal) > 0);
        faced += glm::dot(s.normal, -direction) > 0 ? 1 : -1;
    }
    CHECK(faced == 0);  // the front once, the back once
}

TEST_CASE("Every vector of 1e-36 to 1e37 has its direction, along any axis, and what has none gets another's") {
    CornerFixture f;
    const EmbreeScene embree(f.packed);
    Kernel kernel{f.packed, f.packed.constants, {{embree}}};
    const glm::vec3 fallback(0, 0.6F, -0.8F);
    const glm::dvec3 shapes[] = {{1, 0, 0}, {-1, 0, 0}, {3, -1, 0.5}, {-0.1, 0, 0.01}};
    for (const glm::dvec3& shape : shapes) {
        for (const double size : {1e-35, 1e-25, 1e-15, 1e-5, 1.0, 1e5, 1e15, 1e25, 1e36}) {
            for (int turn = 0; turn < 3; ++turn) {
                const glm::dvec3 v = size * glm::dvec3(shape[turn], shape[(turn + 1) % 3], shape[(turn + 2) % 3]);
                CAPTURE(v.x, v.y, v.z);
                CHECK(glm::length(glm::dvec3(kernel.normalize_or(glm::vec3(v), fallback)) - glm::normalize(v)) < 1e-6);
            }
        }
    }
    const float infinite = std::numeric_limits<float>::infinity();
    for (const float extreme : {0.0F, 1e-38F, -1e-38F, infinite, -infinite}) {
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 v(0);
            v[axis] = extreme;
            CAPTURE(extreme, axis);
            CHECK(kernel.normalize_or(v, fallback) == fallback);
        }
    }
}
