// Ray queries: Embree proposes, double precision decides.
#pragma once

#include <limits>
#include <memory>
#include <optional>

#include "oracle/world.h"

namespace diptych::core::oracle {

inline constexpr std::size_t no_triangle = ~std::size_t{0};

/// Where a ray met the world.
struct Hit {
    std::size_t triangle;
    dvec2 barycentrics;
    double t;
};

struct Ray {
    dvec3 origin;                    // relative to World::origin
    dvec3 direction;                 // unit
    std::size_t from = no_triangle;  // the triangle that the ray starts on, which it cannot meet again
    std::size_t to = no_triangle;    // the triangle that the ray ends on
    double t_max = std::numeric_limits<double>::infinity();
    std::uint64_t coin = 0;  // random bits for surfaces that are there with a probability
};

/// Where the ray's line crosses the triangle's plane, in double; nothing where it is parallel. Barycentrics are
/// unclamped.
std::optional<Hit> cross_plane(const Triangle& triangle, std::size_t index, const Ray& ray);

/// Whether a surface that is crossed at `hit` is there for this ray (docs/integrand.md: Alpha).
bool is_there(const World& world, const Ray& ray, const Hit& hit);

/// The world in Embree, which the world must outlive.
///
/// Embree works in float. Its ray starts a little behind the double origin, so that nothing near it is lost, and each
/// candidate is intersected again in double, where those not in front of the origin are refused. Offsetting the origin
/// forward instead would lose what lies in the gap. The triangle that is left is refused by name.
class Traversal {
public:
    /// Throws Error where Embree does.
    explicit Traversal(const World& world);
    ~Traversal();

    /// The nearest hit.
    std::optional<Hit> closest(const Ray& ray) const;
    /// Whether anything is hit before t_max.
    bool any(const Ray& ray) const;
    /// What Embree holds.
    std::uint64_t bytes() const;

private:
    struct Structures;
    std::unique_ptr<Structures> structures_;
};

}  // namespace diptych::core::oracle
