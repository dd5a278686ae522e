// Rays that leave a triangle which a matrix places: the driver carries them into the mesh's space by an inverse of its
// own.
#include "structures/mesh_units.h"

#include <cmath>

#include "gpu_fixture.h"
#include "geometry/ray_offset.h"

namespace diptych::core::tests {
namespace {

class Random {
public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    double next() { return std::uniform_real_distribution<double>(-1, 1)(engine_); }
    double decades(double count) { return std::pow(10.0, count * next()); }
    glm::dvec3 vector() {
        const double x = next();
        const double y = next();
        return {x, y, next()};
    }

private:
    std::mt19937 engine_;
};

/// Adds a mesh of four triangles about its origin, 0.1 to 10^5 units wide: a ray that leaves one to the inside stays
/// within the mesh's bounds.
void add_tetrahedron(PackedScene& packed, Random& random, double size) {
    packed.meshes.push_back(
        {.first_geometry = static_cast<std::uint32_t>(packed.geometries.size()), .geometry_count = 0});
    std::vector<shared::vec3> corners;
    for (const glm::dvec3& corner : {glm::dvec3(-1, -1, 1), {1, -1, -1}, {-1, 1, -1}, {1, 1, 1}}) {
        corners.emplace_back(size * (corner + 0.3 * random.vector()));
    }
    add_geometry(packed, corners, {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}, 0);
}

/// Turned, stretched and moved; the coordinates of its translation differ by up to six decades.
glm::mat4x3 random_placement(Random& random, double size) {
    const glm::dvec3 x = glm::normalize(random.vector());
    const glm::dvec3 y = glm::normalize(glm::cross(x, random.vector()));
    const double scale = random.decades(2);
    glm::mat4x3 placed(1);
    placed[0] = scale * random.decades(1) * x;
    placed[1] = scale * random.decades(1) * y;
    placed[2] = scale * random.decades(1) * glm::cross(x, y);
    for (int i = 0; i < 3; ++i) {
        placed[3][i] = static_cast<float>(random.next() * scale * size * random.decades(3));
    }
    return placed;
}

/// From a point of a triangle, started as surface.kernel.h starts it, to the side of `inside`.
shared::RecordedRay leave(const shared::vec3 (&corner)[3], const glm::mat4x3& placed, const glm::dvec3& inside,
                          Random& random) {
    const glm::mat3 linear(placed);
    const auto u = static_cast<float>(0.5 * std::abs(random.next()));
    const auto v = static_cast<float>(0.5 * std::abs(random.next()));
    const glm::vec3 position =
        linear * (corner[0] + u * (corner[1] - corner[0]) + v * (corner[2] - corner[0])) + placed[3];
    glm::dvec3 normal = glm::normalize(glm::cross(glm::dmat3(linear) * glm::dvec3(corner[1] - corner[0]),
                                                  glm::dmat3(linear) * glm::dvec3(corner[2] - corner[0])));
    normal = glm::dot(normal, inside - glm::dvec3(position)) < 0 ? -normal : normal;
    const glm::vec3 size = glm::max(glm::abs(corner[0]), glm::max(glm::abs(corner[1]), glm::abs(corner[2])));
    glm::vec3 magnitude = glm::abs(placed[3]);
    for (int i = 0; i < 3; ++i) {
        magnitude += glm::abs(linear[i]) * size[i];
    }
    const glm::dvec3 direction = glm::normalize(random.vector());
    shared::RecordedRay ray{};
    ray.origin = shared::offset_ray(position, glm::vec3(normal), magnitude);
    ray.direction = glm::vec3(glm::dot(direction, normal) < 0 ? -direction : direction);
    ray.t_max = 1e30F;
    return ray;
}

}  // namespace

TEST_CASE("Rays that leave a placed triangle do not meet it") {
    NEED_VULKAN();
    constexpr int placements = 128;
    constexpr int rays_each = 512;
    Random random(1);
    PackedScene packed = random_scene(1, 1, 0, 2);
    std::vector<shared::RecordedRay> rays;
    for (std::uint32_t i = 0; i < placements; ++i) {
        const double size = 100 * random.decades(3);
        add_tetrahedron(packed, random, size);
        const glm::mat4x3 placed = random_placement(random, size);
        add_instance(packed, i + 1, placed);
        const shared::Geometry& geometry = packed.geometries.back();
        const shared::vec3* corners = &packed.positions[geometry.first_vertex];
        const glm::dvec3 inside(placed * glm::vec4(0.25F * (corners[0] + corners[1] + corners[2] + corners[3]), 1));
        for (std::uint32_t k = 0; k < rays_each; ++k) {
            const shared::uvec3 triangle = packed.triangles[geometry.first_triangle + k % 4];
            rays.push_back(
                leave({corners[triangle.x], corners[triangle.y], corners[triangle.z]}, placed, inside, random));
        }
    }
    const std::vector<TracedRay> traced = trace_rays(packed, rays);
    int met_itself = 0;
    int met = 0;
    for (std::size_t i = 0; i < traced.size(); ++i) {
        const shared::Hit& hit = traced[i].hit;
        met += hit.instance != shared::NONE ? 1 : 0;
        met_itself += hit.instance == i / rays_each && hit.primitive == i % 4 ? 1 : 0;
    }
    CHECK(met_itself == 0);
    CHECK(met > placements * rays_each / 2);  // another side of the same body, at least
    check_no_validation_messages();
}

TEST_CASE("A mesh's unit is a power of two for which its matrix outweighs its translation") {
    PackedScene packed = random_scene(1, 3, 0, 2);
    add_instance(packed, 1, glm::mat4x3(1, 0, 0, 0, 1, 0, 0, 0, 1, 1.2F, -307, -1023));
    add_instance(packed, 2, glm::mat4x3(0.001F, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0));
    const std::vector<float> units = mesh_units(packed, {});
    REQUIRE(units.size() == 3);
    CHECK(units[0] == 1);  // placed by nothing
    CHECK(units[1] > 1023);
    CHECK(units[2] * 0.001F > 1023);  // may move to where the other stands
    packed.instances[1].row_0 = {0.001F, 0, 0, 0};
    packed.instances[1].row_1 = {0, 1e11F, 0, 0};
    CHECK(mesh_units(packed, {})[2] <= 0x1p34 / 1e11);  // rays keep a length in its space
    for (const float unit : units) {
        int exponent = 0;
        CHECK(std::frexp(unit, &exponent) == 0.5F);
    }
    // Nothing inverts the matrix of what stands in a group, nor that of a flat instance.
    packed.instance_moves = {0, 0};
    const std::vector<float> grouped = mesh_units(packed, group_instances(packed));
    CHECK(grouped == std::vector<float>(3, 1));
    packed.instances[0].row_0 = {};
    CHECK(mesh_units(packed, {})[1] == 1);
}

}  // namespace diptych::core::tests
