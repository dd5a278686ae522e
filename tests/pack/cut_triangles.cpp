// Large triangles near the camera are cut, and the surface stays what it is.
#include "pack/cut_triangles.h"

#include <map>
#include <random>
#include <set>

#include "pack_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// One triangle with every attribute; side about `size`.
Mesh large_triangle(double size, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1, 1);
    Primitive p;
    p.material = 0;
    for (int k = 0; k < 3; ++k) {
        const double angle = 2 * 3.14159265358979 * k / 3;
        p.positions.emplace_back(glm::dvec3(std::cos(angle), 0.3 * uniform(random), std::sin(angle)) * size);
        p.normals.push_back(glm::normalize(glm::vec3(0.4F * uniform(random), 1, 0.4F * uniform(random))));
        p.tangents.emplace_back(1, 0.1F * uniform(random), 0, -1);
        p.uvs[0].emplace_back(uniform(random), uniform(random));
        p.uvs[1].emplace_back(uniform(random), uniform(random));
        p.colors.emplace_back(uniform(random), uniform(random), uniform(random), 1);
    }
    p.triangles = {{0, 2, 1}};
    return {"large", {p}};
}

std::optional<Mesh> cut_near(const Mesh& mesh, const glm::dvec3& eye, const glm::dmat3& to_world,
                             std::size_t budget = most_cut_triangles) {
    return cut_near_triangles(mesh, eye, to_world, budget);
}

glm::dvec3 normal_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return glm::cross(b - a, c - a);
}

/// How large a triangle is for its distance to the origin, by its nearest of many points.
double largeness(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    double nearest = 1e300;
    for (int i = 0; i <= 40; ++i) {
        for (int j = 0; j <= 40 - i; ++j) {
            nearest = std::min(nearest, glm::length(a + (b - a) * (i / 40.0) + (c - a) * (j / 40.0)));
        }
    }
    return std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)}) / nearest;
}

}  // namespace

TEST_CASE("A triangle near the eye is cut until it is no larger than it may be, and nothing of it is lost") {
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        const double size = 1e5;
        const Mesh mesh = large_triangle(size, seed);
        const Primitive& whole = mesh.primitives[0];
        const auto corner = [&](std::size_t k) { return glm::dvec3(whole.positions[k]); };
        const glm::dvec3 whole_normal = normal_of(corner(0), corner(2), corner(1));
        const glm::dvec3 unit = glm::normalize(whole_normal);
        // Off the middle, two metres above.
        const glm::dvec3 eye = 0.5 * corner(0) + 0.3 * corner(1) + 0.2 * corner(2) + 2.0 * (unit.y < 0 ? -unit : unit);
        const std::optional<Mesh> cut = cut_near(mesh, eye, glm::dmat3(1));
        REQUIRE(cut);
        const Primitive& p = cut->primitives[0];
        CHECK(p.triangles.size() > 10);
        CHECK(p.triangles.size() < 1000);
        double area = 0;
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        for (const glm::uvec3& t : p.triangles) {
            const glm::dvec3 a(p.positions[t.x]);
            const glm::dvec3 b(p.positions[t.y]);
            const glm::dvec3 c(p.positions[t.z]);
            const glm::dvec3 normal = normal_of(a, b, c);
            area += glm::length(normal);
            CHECK(glm::dot(normal, whole_normal) > 0.9999 * glm::length(normal) * glm::length(whole_normal));
            CHECK(largeness(a, b, c) <= 1.05 * longest_near_edge);
            for (int k = 0; k < 3; ++k) {
                ++edges[std::minmax(t[k], t[(k + 1) % 3])];
            }
        }
        CHECK(area == Approx(glm::length(whole_normal)).epsilon(1e-6));
        // No vertex lies within an edge: what belongs to one triangle alone is part of the outline.
        for (const auto& [edge, triangles] : edges) {
            CHECK(triangles <= 2);
            if (triangles == 1) {
                const glm::dvec3 middle =
                    0.5 * (glm::dvec3(p.positions[edge.first]) + glm::dvec3(p.positions[edge.second])) + eye;
                double off = 1e300;
                for (std::size_t k = 0; k < 3; ++k) {
                    const glm::dvec3 side = corner((k + 1) % 3) - corner(k);
                    off = std::min(off, glm::length(glm::cross(side, middle - corner(k))) / glm::length(side));
                }
                CHECK(off < 1e-5 * size);
            }
        }
        // Attributes are those of the whole at the same place.
        for (std::size_t v = 0; v < p.positions.size(); ++v) {
            const glm::dvec3 at = glm::dvec3(p.positions[v]) + eye;
            const glm::dvec3 w(glm::dot(normal_of(at, corner(1), corner(2)), -unit),
                               glm::dot(normal_of(at, corner(2), corner(0)), -unit),
                               glm::dot(normal_of(at, corner(0), corner(1)), -unit));
            const glm::vec3 weight = w / glm::dot(glm::dvec3(1), w);
            const auto of_whole = [&](const auto& values) {
                return weight.x * values[0] + weight.y * values[1] + weight.z * values[2];
            };
            CHECK(glm::length(p.normals[v] - of_whole(whole.normals)) < 1e-4F);
            CHECK(glm::length(p.uvs[0][v] - of_whole(whole.uvs[0])) < 1e-4F);
            CHECK(glm::length(p.uvs[1][v] - of_whole(whole.uvs[1])) < 1e-4F);
            CHECK(glm::length(p.colors[v] - of_whole(whole.colors)) < 1e-4F);
            CHECK(glm::length(p.tangents[v] - of_whole(whole.tangents)) < 1e-4F);
            CHECK(p.tangents[v].w == -1);
        }
    }
}

TEST_CASE("Neighbours that share an edge are cut there alike, across primitives too") {
    Mesh mesh;
    mesh.primitives.resize(2);
    for (std::size_t k = 0; k < 2; ++k) {
        Primitive& p = mesh.primitives[k];
        p.material = 0;
        p.positions = {{-1e6F, 0, 0}, {1e6F, 10, 0}, {0, 0, k == 0 ? 1e6F : -1e6F}};
        p.triangles = {k == 0 ? glm::uvec3(0, 2, 1) : glm::uvec3(0, 1, 2)};
    }
    // Nearer to one of them than to the edge.
    const std::optional<Mesh> cut = cut_near(mesh, {3e3, 6, 40}, glm::dmat3(1));
    REQUIRE(cut);
    const auto on_edge = [&](const Primitive& p) {
        std::set<float> along;
        for (const glm::vec3& position : p.positions) {
            if (position.z == -40) {
                along.insert(position.x);
            }
        }
        return along;
    };
    CHECK(on_edge(cut->primitives[0]).size() > 4);
    CHECK(on_edge(cut->primitives[0]) == on_edge(cut->primitives[1]));
}

TEST_CASE("What is small for its distance stays as it is, and what stands twice or moves") {
    CHECK(!cut_near(large_triangle(1, 1), {0.5, 1, 0.5}, glm::dmat3(1)));
    CHECK(!cut_near(large_triangle(1e5, 1), {0, 1e5, 0}, glm::dmat3(1)));
    CHECK(cut_near(large_triangle(1, 1), {0, 1, 0}, glm::dmat3(1e6, 0, 0, 0, 1, 0, 0, 0, 1e6)));
    CHECK(!cut_near({"empty", {}}, glm::dvec3(0), glm::dmat3(1)));
    // In the triangle's plane, at a corner of it: cut, but not forever.
    const Mesh touched = large_triangle(1e5, 1);
    const std::optional<Mesh> cut =
        cut_near(touched, glm::dvec3(touched.primitives[0].positions[0]), glm::dmat3(1));
    REQUIRE(cut);
    CHECK(cut->primitives[0].triangles.size() < 1000);

    Scene scene = least_scene();
    scene.meshes.push_back(large_triangle(1e6, 2));
    for (glm::vec3& position : scene.meshes[1].primitives[0].positions) {
        position.y = 0;
    }
    add_instance(scene, "ground", 1, translation(0, -0.5, 0));
    const PackedScene near = pack_scene(scene, brdf_settings());
    CHECK(near.triangles.size() > 12);
    CHECK(near.mesh_frames[1].center != glm::dvec3(0));
    add_instance(scene, "again", 1, translation(0, -2, 0));
    CHECK(pack_scene(scene, brdf_settings()).triangles.size() == 3);
    scene.instances.pop_back();
    scene.instances.back().node = 0;
    CHECK(pack_scene(scene, brdf_settings()).triangles.size() == 3);
}
