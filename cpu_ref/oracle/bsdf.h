// The material's scattering for one normal (docs/integrand.md: Material), in world space.
#pragma once

#include <glm/glm.hpp>

#include "oracle/random.h"

namespace diptych::core::oracle {

using glm::dvec2;
using glm::dvec3;

inline constexpr double pi = 3.14159265358979323846;

enum class Distribution { ggx, blinn_phong };

/// What textures and factors come to at one point.
struct Bsdf {
    Distribution model = Distribution::ggx;
    double alpha = 1;
    dvec3 diffuse{0};
    dvec3 f0{0};
    double f90 = 0;

    /// The specular part is a perfect mirror.
    bool is_mirror() const { return alpha < 1e-4; }
    bool has_specular() const { return f90 > 0 || f0 != dvec3(0); }
};

/// A direction with f cos / density; weight 0 where the draw failed. `mirrored`: the density is a Dirac delta.
struct Scattered {
    dvec3 i{0};
    dvec3 weight{0};
    bool mirrored = false;
};

/// Normals a steradian, for the cosine of h to the normal and the squared sine.
double ndf(Distribution model, double alpha, double cosine, double sine_squared);
/// Smith's Lambda at the cosine `c` > 0 to the normal.
double smith_lambda(Distribution model, double alpha, double c);
/// Cosine to the normal of a half vector drawn with density D(h) cos(h), from uniform u.
double sample_ndf_cosine(Distribution model, double alpha, double u);

dvec3 fresnel(const Bsdf& bsdf, double cosine);

/// f(o, i) (i·n) without a mirror's part; o, i, n unit.
dvec3 evaluate(const Bsdf& bsdf, const dvec3& n, const dvec3& o, const dvec3& i);

/// Picks the diffuse or the specular part and draws from it: cosine, D(h) cos(h), or the mirrored direction.
Scattered sample(const Bsdf& bsdf, const dvec3& n, const dvec3& o, Random& random);

/// The chance with which `sample` takes the specular part.
double specular_share(const Bsdf& bsdf, const dvec3& n, const dvec3& o);

/// Of `sample`'s draws at i a steradian, both parts together; a mirror's part, which has none, left out.
double density(const Bsdf& bsdf, const dvec3& n, const dvec3& o, const dvec3& i);

/// The mirror's part alone; weight 0 where there is none.
Scattered sample_mirror(const Bsdf& bsdf, const dvec3& n, const dvec3& o);

/// The unit vector with cosine `c` to the unit vector `n`, at `angle` about it.
dvec3 around(const dvec3& n, double c, double angle);

/// The unit vector of the plane of n and `axis` whose cosine to `axis` is c, on n's side; `axis` where n is along it.
dvec3 with_cosine(const dvec3& n, const dvec3& axis, double c);

/// w mirrored in the plane across n; -w mirrored is the direction light takes.
inline dvec3 flip_across(const dvec3& w, const dvec3& n) {
    return w - 2 * glm::dot(w, n) * n;
}

inline double largest(const dvec3& v) {
    return glm::max(v.x, glm::max(v.y, v.z));
}

}  // namespace diptych::core::oracle
