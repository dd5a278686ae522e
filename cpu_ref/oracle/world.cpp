#include "oracle/world.h"

#include <limits>

namespace diptych::oracle {

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
        const glm::dmat3 linear(instance.object_to_world);
        world.frames.push_back({linear, transpose(inverse(linear)), determinant(linear) < 0});
    }
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
            const dvec3 normal = cross(triangle.ab, triangle.ac);
            if (!(length(normal) > 0)) {
                continue;
            }
            triangle.front = normalize(normal) * (world.frames[instance].mirrored ? -1.0 : 1.0);
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

}  // namespace diptych::oracle
