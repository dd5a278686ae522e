#include "oracle/world.h"

#include <limits>

#include "oracle/duplicates.h"

namespace diptych::core::oracle {

namespace {

dvec3 transform_point(const glm::dmat4& m, const glm::vec3& p) {
    return dvec3(m * dvec4(dvec3(p), 1));
}

template <typename Visit>
void visit_primitives(const Scene& scene, Visit visit) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        for (const Primitive& primitive : scene.meshes[std::size_t(scene.instances[i].mesh)].primitives) {
            visit(i, primitive);
        }
    }
}

Frame make_frame(const glm::dmat3& m) {
    const double volume = length(m[0]) * length(m[1]) * length(m[2]);
    const bool mirrored = determinant(m) < -1e-12 * volume;
    const glm::dmat3 cofactors(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
    return {m, mirrored ? -cofactors : cofactors, mirrored};
}

/// What is less of the longest side's square is a line that rounding widened.
constexpr double least_area = 1e-13;

bool has_area(const Triangle& t) {
    const dvec3 third = t.c - t.b;
    const double longest = glm::max(dot(t.ab, t.ab), glm::max(dot(t.ac, t.ac), dot(third, third)));
    return length(cross(t.ab, t.ac)) > least_area * longest;
}

/// Sets origin and extent from the box around every vertex that is used.
void find_extent(World& world) {
    dvec3 low(std::numeric_limits<double>::infinity());
    dvec3 high(-std::numeric_limits<double>::infinity());
    visit_primitives(*world.scene, [&](std::size_t instance, const Primitive& primitive) {
        for (const glm::uvec3& triangle : primitive.triangles) {
            for (int k = 0; k < 3; ++k) {
                const dvec3 p =
                    transform_point(world.scene->instances[instance].object_to_world, primitive.positions[triangle[k]]);
                low = min(low, p);
                high = max(high, p);
            }
        }
    });
    const bool empty = !(low.x <= high.x);
    world.origin = empty ? dvec3(0) : 0.5 * (low + high);
    world.extent = empty ? 1 : 0.5 * length(high - low);
}

}  // namespace

World make_world(const Scene& scene) {
    World world{};
    world.scene = &scene;
    find_extent(world);
    for (const Instance& instance : scene.instances) {
        world.frames.push_back(make_frame(glm::dmat3(instance.object_to_world)));
    }
    Duplicates duplicates(scene);
    visit_primitives(scene, [&](std::size_t instance, const Primitive& primitive) {
        glm::dmat4 matrix = scene.instances[instance].object_to_world;
        matrix[3] -= dvec4(world.origin, 0);
        for (const glm::uvec3& vertex : primitive.triangles) {
            Triangle triangle{};
            triangle.a = transform_point(matrix, primitive.positions[vertex.x]);
            triangle.b = transform_point(matrix, primitive.positions[vertex.y]);
            triangle.c = transform_point(matrix, primitive.positions[vertex.z]);
            triangle.ab = triangle.b - triangle.a;
            triangle.ac = triangle.c - triangle.a;
            if (duplicates.met_before(instance, primitive, vertex) || !has_area(triangle)) {
                continue;
            }
            const double side = world.frames[instance].mirrored ? -1 : 1;
            triangle.front = side * normalize(cross(triangle.ab, triangle.ac));
            triangle.vertex = vertex;
            triangle.primitive = &primitive;
            triangle.material = &scene.materials[std::size_t(primitive.material)];
            triangle.frame = unsigned(instance);
            world.has_alpha = world.has_alpha || triangle.material->alpha_mode != AlphaMode::opaque;
            world.triangles.push_back(triangle);
        }
    });
    return world;
}

}  // namespace diptych::core::oracle
