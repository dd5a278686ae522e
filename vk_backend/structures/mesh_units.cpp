#include "structures/mesh_units.h"

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

namespace diptych::core {
namespace {

// Margin for instances and cameras that move after the build.
constexpr double room = 0x1p12;

// The smallest width of a mesh in its unit. Drivers multiply edges: products of edges of 2^-63 vanish in fp32, and so
// does the triangle.
constexpr double least_width = 0x1p-40;

// The largest norm of A in the chosen unit. In the mesh's space a ray's direction is shorter by the norm of A. With
// directions below 2^-40 the driver of an H200 misses triangles, and with still shorter ones everything in the mesh's
// box.
constexpr double longest = 0x1p34;

double norm(const glm::dmat3& m) {
    return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

glm::dmat3 linear_part(const shared::Instance& i) {
    return glm::transpose(glm::dmat3(glm::dvec3(i.row_0), glm::dvec3(i.row_1), glm::dvec3(i.row_2)));
}

double distance(const shared::Instance& i) {
    return glm::length(glm::dvec3(i.row_0.w, i.row_1.w, i.row_2.w));
}

/// The factor by which A has to grow so that no entry of t becomes a pivot, for |t| = `reach`. Elimination multiplies
/// t by at most the condition number of A, and the remainder of A is at least 1 / |A^-1|.
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
    std::vector<double> wanted(packed.meshes.size(), 0);  // as exponents of two
    std::vector<double> most;
    for (const double width : mesh_widths(packed)) {
        most.push_back(std::floor(std::log2(width / least_width)));
    }
    double reach = 0;
    for (const shared::Instance& instance : packed.instances) {
        reach = std::max(reach, distance(instance));
    }
    for (std::size_t i = 0; i < packed.instances.size(); ++i) {
        if (!is_shown(packed, i) || is_grouped(groups, i)) {
            continue;
        }
        const std::uint32_t mesh = packed.instance_meshes[i];
        const glm::dmat3 a = linear_part(packed.instances[i]);
        const double needed = std::ceil(std::log2(room * needed_factor(a, reach)));
        if (std::isfinite(needed)) {  // a singular matrix has no inverse
            wanted[mesh] = std::max(wanted[mesh], needed);
            most[mesh] = std::min(most[mesh], MUTANT(DIRECTIONS_VANISH, std::floor(std::log2(longest / norm(a))), 1000.0));
        }
    }
    std::vector<float> units(packed.meshes.size(), 1.0F);
    for (std::size_t mesh = 0; mesh < units.size(); ++mesh) {
        const double doublings = std::min(wanted[mesh], most[mesh]);
        if (std::isfinite(doublings)) {  // infinite for an empty mesh
            units[mesh] = MUTANT(MESHES_IN_OWN_UNITS, std::ldexp(1.0F, static_cast<int>(doublings)), 1.0F);
        }
    }
    return units;
}

}  // namespace diptych::core
