#include <cmath>
#include <optional>

#include "compat.h"
#include "pack/cut_triangles.h"
#include "pack/pack_parts.h"

namespace diptych {
namespace {

template <class T>
std::uint32_t append(std::vector<T>& buffer, const std::vector<T>& values, bool wanted, const Scene& scene,
                     const char* what) {
    if (values.empty() || !wanted) {
        return shared::NONE;
    }
    require_indexable(scene, buffer.size() + values.size(), what);
    const auto first = static_cast<std::uint32_t>(buffer.size());
    buffer.insert(buffer.end(), values.begin(), values.end());
    return first;
}

/// Where a mesh's vertices lie, if that is so far from their own origin that its triangles would lose digits there;
/// else 0. Differences of such vertices are exact.
glm::dvec3 center_of(const Mesh& mesh) {
    glm::dvec3 low(1e300);
    glm::dvec3 high(-1e300);
    for (const Primitive& primitive : mesh.primitives) {
        for (const glm::vec3& p : primitive.positions) {
            low = glm::min(low, glm::dvec3(p));
            high = glm::max(high, glm::dvec3(p));
        }
    }
    const glm::dvec3 middle = 0.5 * (low + high);
    const bool far = glm::length(middle) > 8 * glm::length(0.5 * (high - low)) && high.x >= low.x;
    return MUTANT(MESH_NOT_CENTRED, far, false) ? glm::dvec3(glm::vec3(middle)) : glm::dvec3(0);
}

/// A mesh cut about the eye, and where that is in the mesh's space.
struct NearMesh {
    Mesh mesh;
    glm::dvec3 eye;
};

/// Of a mesh that stands in one place for good: others are near the eye here and far there.
std::optional<NearMesh> near_mesh(const Mesh& mesh, const std::vector<const Instance*>& users,
                                  const glm::dvec3& origin) {
    if (users.size() != 1 || users.front()->node != none) {
        return std::nullopt;
    }
    const glm::dmat4& placed = users.front()->object_to_world;
    const glm::dvec3 eye = glm::inverse(glm::dmat3(placed)) * (origin - glm::dvec3(placed[3]));
    if (!std::isfinite(eye.x + eye.y + eye.z)) {
        return std::nullopt;
    }
    std::optional<Mesh> cut =
        MUTANT(TRIANGLES_NOT_CUT, cut_near_triangles(mesh, eye, glm::dmat3(placed)), std::optional<Mesh>());
    return cut ? std::optional<NearMesh>({*std::move(cut), eye}) : std::nullopt;
}

}  // namespace

void pack_meshes(const Scene& scene, PackedScene& packed) {
    const auto has = [&](std::uint32_t bit) { return (packed.features & bit) != 0; };
    std::vector<std::vector<const Instance*>> users(scene.meshes.size());
    for (const Instance& instance : scene.instances) {
        users[static_cast<std::size_t>(instance.mesh)].push_back(&instance);
    }
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        MeshRange range{static_cast<std::uint32_t>(packed.geometries.size()), 0};
        const std::optional<NearMesh> near = near_mesh(scene.meshes[i], users[i], packed.origin);
        const Mesh& mesh = near ? near->mesh : scene.meshes[i];
        const glm::dvec3 center = near ? glm::dvec3(0) : center_of(mesh);
        packed.mesh_centers.push_back(near ? near->eye : center);
        for (const Primitive& primitive : mesh.primitives) {
            if (users[i].empty() || primitive.triangles.empty()) {
                continue;
            }
            const Material& material = scene.materials[static_cast<std::size_t>(primitive.material)];
            shared::Geometry g{};
            g.first_triangle = append(packed.triangles, primitive.triangles, true, scene, "triangles");
            g.first_vertex = append(packed.positions, primitive.positions, true, scene, "vertices");
            for (std::size_t v = g.first_vertex; center != glm::dvec3(0) && v < packed.positions.size(); ++v) {
                packed.positions[v] = glm::vec3(glm::dvec3(packed.positions[v]) - center);
            }
            g.first_normal = append(packed.normals, primitive.normals, true, scene, "normals");
            const bool mapped = has(shared::FEATURE_NORMAL_MAPS) && material.normal_texture.texture != none;
            g.first_tangent = append(packed.tangents, primitive.tangents, mapped, scene, "tangents");
            const bool textured = has(shared::FEATURE_TEXTURES);
            g.first_uv_0 = append(packed.uvs, primitive.uvs[0], textured, scene, "texture coordinates");
            g.first_uv_1 = append(packed.uvs, primitive.uvs[1], textured && has(shared::FEATURE_SECOND_UV), scene,
                                  "texture coordinates");
            g.first_color = append(packed.colors, primitive.colors, true, scene, "vertex colours");
            g.material = static_cast<std::uint32_t>(primitive.material);
            packed.geometries.push_back(g);
            packed.geometry_extents.push_back({static_cast<std::uint32_t>(primitive.triangles.size()),
                                               static_cast<std::uint32_t>(primitive.positions.size()),
                                               material.alpha_mode != AlphaMode::opaque});
            ++range.geometry_count;
        }
        packed.meshes.push_back(range);
    }
}

bool place_instance(const Instance& instance, const glm::dvec3& origin, const glm::dvec3& center,
                    shared::Instance& out) {
    const glm::dmat4& m = instance.object_to_world;
    const glm::dmat3 linear(m);
    const glm::dvec3 moved = glm::dvec3(m[3]) - origin + linear * center;
    const double determinant = glm::determinant(linear);
    const double scale = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
    const auto row = [&](int r) { return glm::vec4(glm::dvec4(m[0][r], m[1][r], m[2][r], moved[r])); };
    out.row_0 = row(0);
    out.row_1 = row(1);
    out.row_2 = row(2);
    out.mirrored = determinant < 0 ? 1U : 0U;
    // Against the columns' lengths, so that small scales are no reason to refuse.
    return std::abs(determinant) > 1e-12 * scale && std::isfinite(scale);
}

void pack_instances(const Scene& scene, PackedScene& packed) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const MeshRange& range = packed.meshes[static_cast<std::size_t>(instance.mesh)];
        if (range.geometry_count == 0) {
            continue;
        }
        shared::Instance out{};
        const bool shown =
            place_instance(instance, packed.origin, packed.mesh_centers[static_cast<std::size_t>(instance.mesh)], out);
        if (!shown && instance.node == none) {
            packed.warnings.push_back(scene.name + ": instance \"" + instance.name +
                                      "\": its transform flattens it to nothing; left out");
            continue;
        }
        out.first_geometry = range.first_geometry;
        out.first_emitter_slot = shared::NONE;
        packed.instances.push_back(out);
        packed.instance_meshes.push_back(static_cast<std::uint32_t>(instance.mesh));
        packed.scene_instances.push_back(static_cast<std::uint32_t>(i));
        packed.instance_shown.push_back(shown ? 1 : 0);
        packed.instance_moves.push_back(instance.node == none ? 0 : 1);
    }
    require_indexable(scene, packed.instances.size(), "instances");
}

}  // namespace diptych
