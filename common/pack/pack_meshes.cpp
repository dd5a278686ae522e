#include <algorithm>
#include <optional>
#include <utility>

#include "language/compat.h"
#include "pack/cut_triangles.h"
#include "pack/linear_part.h"
#include "pack/pack_parts.h"
#include "pack/range.h"

namespace diptych::core {
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

/// Where an instance of a planned mesh stands, without the frame's own center.
glm::dmat4 placement(const Scene& scene, const PlannedMesh& planned) {
    glm::dmat4 in_world(1);
    in_world[3] = glm::dvec4(planned.frame.center, 1);
    return planned.frame.in_world ? in_world : scene.instances[planned.users.front()].object_to_world;
}

/// Cuts what is large near the eye, of a mesh that stands in one place for good: others are near here and far there.
void cut_near_eye(const Scene& scene, const PackedScene& packed, std::size_t& budget, PlannedMesh& planned) {
    if (planned.users.size() != 1 || scene.instances[planned.users.front()].node != none) {
        return;
    }
    const glm::dmat4 placed = placement(scene, planned);
    const glm::dmat3 linear(placed);
    const double distance = sizes_away(planned.frame, placed, packed.origin);
    if (!planned.frame.in_world && !has_good_inverse(linear, distance, packed.reach)) {
        return;
    }
    const glm::dvec3 eye = glm::inverse(linear) * (packed.origin - glm::dvec3(placed[3]));
    std::optional<Mesh> cut = MUTANT(TRIANGLES_NOT_CUT, cut_near_triangles(*planned.mesh, eye, linear, budget),
                                     std::optional<Mesh>());
    if (cut) {
        planned.own = std::make_shared<Mesh>(*std::move(cut));
        planned.mesh = planned.own.get();
        planned.frame.center = planned.frame.in_world ? planned.frame.center + eye : eye;
        planned.frame.unit = 1;
        planned.cut = true;
    }
}

/// Appends the vertices of a primitive as the frame has them.
std::uint32_t append_positions(const Scene& scene, const PlannedMesh& planned, const std::vector<glm::vec3>& positions,
                               PackedScene& packed) {
    const std::uint32_t first = append(packed.positions, positions, true, scene, "vertices");
    const MeshFrame& frame = planned.frame;
    const bool as_they_are = planned.cut || frame.in_world || (frame.center == glm::dvec3(0) && frame.unit == 1);
    for (std::size_t v = first; !as_they_are && v < packed.positions.size(); ++v) {
        packed.positions[v] = glm::vec3((glm::dvec3(packed.positions[v]) - frame.center) / frame.unit);
    }
    return first;
}

}  // namespace

void pack_meshes(const Scene& scene, MeshPlan& plan, PackedScene& packed) {
    const auto has = [&](std::uint32_t bit) { return (packed.features & bit) != 0; };
    std::size_t cut_budget = most_cut_triangles;
    for (PlannedMesh& planned : plan.meshes) {
        MeshRange range{static_cast<std::uint32_t>(packed.geometries.size()), 0};
        cut_near_eye(scene, packed, cut_budget, planned);
        packed.mesh_frames.push_back(planned.frame);
        for (const Primitive& primitive : planned.mesh->primitives) {
            if (planned.users.empty() || primitive.triangles.empty()) {
                continue;
            }
            const Material& material = scene.materials[static_cast<std::size_t>(primitive.material)];
            shared::Geometry g{};
            g.first_triangle = append(packed.triangles, primitive.triangles, true, scene, "triangles");
            g.first_vertex = append_positions(scene, planned, primitive.positions, packed);
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

std::optional<double> place_instance(const Instance& instance, const glm::dvec3& origin, const MeshFrame& frame,
                                     double reach, shared::Instance& out) {
    const glm::dmat4& m = instance.object_to_world;
    const glm::dmat3 linear(m);
    out.mirrored = mirrors(linear) ? 1U : 0U;
    glm::dmat3 packed_linear = frame.in_world ? glm::dmat3(1) : linear * frame.unit;
    glm::dvec3 moved = frame.in_world ? frame.center - origin : glm::dvec3(m[3]) - origin + linear * frame.center;
    bool shown = true;
    const double distance = sizes_away(frame, m, origin);
    if (!frame.in_world && !is_well_conditioned(packed_linear, largest_condition(distance))) {
        const std::optional<glm::dmat3> thick = thickened(packed_linear, frame.spread, least_thickness(distance));
        shown = MUTANT(THICKENED_HIDDEN, thick.has_value(), false);
        moved += (packed_linear - thick.value_or(packed_linear)) * frame.middle;
        packed_linear = thick.value_or(packed_linear);
    }
    const auto row = [&](int r) {
        return glm::vec4(glm::dvec4(packed_linear[0][r], packed_linear[1][r], packed_linear[2][r], moved[r]));
    };
    out.row_0 = row(0);
    out.row_1 = row(1);
    out.row_2 = row(2);
    const double size = largest_column(packed_linear);
    shown = shown && size > 1e-13 * std::max(reach, 1.0);
    return shown ? std::optional<double>(0.5 * least_thickness(distance) * size) : std::nullopt;
}

void pack_instances(const Scene& scene, const MeshPlan& plan, PackedScene& packed) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const int mesh = plan.of_instances[i];
        if (mesh == none || packed.meshes[static_cast<std::size_t>(mesh)].geometry_count == 0) {
            continue;
        }
        shared::Instance out{};
        const std::optional<double> unit = place_instance(
            instance, packed.origin, packed.mesh_frames[static_cast<std::size_t>(mesh)], packed.reach, out);
        packed.least_unit = std::min(packed.least_unit, unit.value_or(1));
        out.first_geometry = packed.meshes[static_cast<std::size_t>(mesh)].first_geometry;
        out.first_emitter_slot = shared::NONE;
        packed.instances.push_back(out);
        packed.instance_meshes.push_back(static_cast<std::uint32_t>(mesh));
        packed.scene_instances.push_back(static_cast<std::uint32_t>(i));
        packed.instance_shown.push_back(unit ? 1 : 0);
        packed.instance_moves.push_back(instance.node == none ? 0 : 1);
    }
    require_indexable(scene, packed.instances.size(), "instances");
}

}  // namespace diptych::core
