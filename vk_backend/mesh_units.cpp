#include "mesh_units.h"

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

namespace diptych {
namespace {

// For instances, and cameras, that move after the structures were built.
constexpr double room = 0x1p12;

constexpr int most_doublings = 96;  // vertices, and matrices, stay normal numbers

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

}  // namespace

std::vector<float> mesh_units(const PackedScene& packed, const InstanceGroups& groups) {
    std::vector<float> units(packed.meshes.size(), 1.0F);
    double reach = 0;
    for (const shared::Instance& instance : packed.instances) {
        reach = std::max(reach, distance(instance));
    }
    for (std::size_t i = 0; i < packed.instances.size(); ++i) {
        if (!is_shown(packed, i) || is_grouped(groups, i)) {
            continue;
        }
        const double doublings = std::ceil(std::log2(room * needed_factor(linear_part(packed.instances[i]), reach)));
        if (std::isfinite(doublings)) {  // a singular matrix has no inverse to be rounded
            float& unit = units[packed.instance_meshes[i]];
            unit = std::max(unit, std::ldexp(1.0F, std::clamp(static_cast<int>(doublings), 0, most_doublings)));
        }
    }
    return MUTANT(MESHES_IN_OWN_UNITS, units, std::vector<float>(packed.meshes.size(), 1.0F));
}

}  // namespace diptych
