#include "mesh_units.h"

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

namespace diptych {
namespace {

// For instances, and cameras, that move after the structures were built.
constexpr double room = 0x1p12;

// A mesh is at least so wide in its unit. Drivers multiply edges: products of edges of 2^-63 vanish in fp32, and with
// them the triangle.
constexpr double least_width = 0x1p-40;

double norm(const glm::dmat3& m) {
    return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

glm::dmat3 linear_part(const shared::Instance& i) {
    return glm::transpose(glm::dmat3(glm::dvec3(i.row_0), glm::dvec3(i.row_1), glm::dvec3(i.row_2)));
}

double distance(const shared::Instance& i) {
    return glm::length(glm::dvec3(i.row_0.w, i.row_1.w, i.row_2.w));
}

/// The factor by which A has to grow so that no entry of t becomes a pivot, |t| being `reach`. Elimination multiplies t
/// by no more than A's condition number, and what it leaves of A is no smaller than 1 / |A^-1|.
double needed_factor(const glm::dmat3& a, double reach) {
    const double inverse = norm(glm::inverse(a));
    return (reach + norm(a)) * norm(a) * inverse * inverse;
}

/// The largest coordinate of each mesh's vertices.
std::vector<double> mesh_widths(const PackedScene& packed) {
    std::vector<double> widths;
    for (const MeshRange& mesh : packed.meshes) {
        double width = 0;
        for (std::uint32_t g = mesh.first_geometry; g < mesh.first_geometry + mesh.geometry_count; ++g) {
            const std::uint32_t first = packed.geometries[g].first_vertex;
            for (std::uint32_t v = first; v < first + packed.geometry_extents[g].vertex_count; ++v) {
                const shared::vec3 p = shared::abs(packed.positions[v]);
                width = std::max(width, static_cast<double>(std::max(p.x, std::max(p.y, p.z))));
            }
        }
        widths.push_back(width);
    }
    return widths;
}

}  // namespace

std::vector<float> mesh_units(const PackedScene& packed, const InstanceGroups& groups) {
    std::vector<float> units(packed.meshes.size(), 1.0F);
    const std::vector<double> widths = mesh_widths(packed);
    double reach = 0;
    for (const shared::Instance& instance : packed.instances) {
        reach = std::max(reach, distance(instance));
    }
    for (std::size_t i = 0; i < packed.instances.size(); ++i) {
        if (!is_shown(packed, i) || is_grouped(groups, i)) {
            continue;
        }
        const std::uint32_t mesh = packed.instance_meshes[i];
        const double wanted = std::ceil(std::log2(room * needed_factor(linear_part(packed.instances[i]), reach)));
        const double most = std::floor(std::log2(widths[mesh] / least_width));
        const double doublings = std::min(wanted, most);
        if (doublings > 0 && std::isfinite(doublings)) {  // a singular matrix has no inverse to be rounded
            units[mesh] = std::max(units[mesh], std::ldexp(1.0F, static_cast<int>(doublings)));
        }
    }
    return MUTANT(MESHES_IN_OWN_UNITS, units, std::vector<float>(packed.meshes.size(), 1.0F));
}

}  // namespace diptych
