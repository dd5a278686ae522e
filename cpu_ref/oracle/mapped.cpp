#include "oracle/mapped.h"

#include <cmath>

#include "oracle/facets.h"

namespace diptych::core::oracle {

namespace {

/// The range of a normal's factor at the most; a normal that leans by less has less.
constexpr double most_range = 0.25;

bool leaves(const Mapped& m, const dvec3& i) {
    return dot(i, m.geometric) > least_light_cosine;
}

/// S of eq. 3: takes light to 0 where it sinks below the surface.
double sinking_factor(const Mapped& m, const dvec3& n, double width, const dvec3& i) {
    const double lean = width * glm::min(most_range, length(cross(n, m.geometric))) * dot(i, n);
    const double x = lean > 0 ? glm::min(1.0, dot(i, m.geometric) / lean) : 1;
    return x + x * x - x * x * x;
}

/// The normal of the specular term. With a normal at the angle phi from n_g toward p, the mirror direction's cosine to
/// n_g is 2 (o.q)(q.n_g) - o.n_g = c cos(2 phi) + s sin(2 phi) = r cos(2 phi - psi), with c and s the parts of o along
/// n_g and across it toward p. From c, where phi is 0, it falls to theta once.
dvec3 specular_normal(const dvec3& geometric, const dvec3& p, const dvec3& o) {
    const double c = dot(o, geometric);
    const double theta = glm::min(0.9 * c, 0.1);
    if (2 * dot(o, p) * dot(p, geometric) - c >= theta) {
        return p;
    }
    const dvec3 across = normalize(p - dot(p, geometric) * geometric);
    const double s = dot(o, across);
    const double phi = 0.5 * (std::atan2(s, c) + std::acos(theta / std::hypot(c, s)));
    return std::cos(phi) * geometric + std::sin(phi) * across;
}

Bsdf specular_part(const Bsdf& bsdf) {
    Bsdf specular = bsdf;
    specular.diffuse = dvec3(0);
    return specular;
}

}  // namespace

Mapped make_mapped(const dvec3& geometric, const dvec3& mapped, const dvec3& o) {
    const dvec3 p = held_above(mapped, geometric);
    return {geometric, p, specular_normal(geometric, p, o)};
}

dvec3 evaluate(const Mapped& m, const Bsdf& bsdf, const dvec3& o, const dvec3& i) {
    if (!leaves(m, i)) {
        return dvec3(0);
    }
    const dvec3 h = normalize(o + i);
    const dvec3 diffuse = bsdf.diffuse / pi * (1.0 - fresnel(bsdf, dot(o, h))) * glm::max(dot(i, m.p), 0.0);
    const Bsdf specular = specular_part(bsdf);
    const dvec3 reflected = evaluate(specular, m.q, o, i) + evaluate(specular, m.q, o, flip_across(i, m.geometric));
    return sinking_factor(m, m.p, 1, i) * diffuse + sinking_factor(m, m.q, bsdf.alpha, i) * reflected;
}

Scattered sample(const Mapped& m, const Bsdf& bsdf, const dvec3& o, bool only_mirror, Random& random) {
    const double share = only_mirror ? 1 : specular_share(bsdf, m.q, o);
    Scattered drawn;
    if (random.uniform() >= share) {
        const double u = random.uniform();
        drawn.i = around(m.p, std::sqrt(1 - u), 2 * pi * random.uniform());
    } else if (only_mirror || bsdf.is_mirror()) {
        drawn = sample_mirror(bsdf, m.q, o);
        drawn.weight = leaves(m, drawn.i) ? drawn.weight / share : dvec3(0);
        return drawn;
    } else {
        drawn = sample(specular_part(bsdf), m.q, o, random);
        if (drawn.weight == dvec3(0)) {
            return drawn;
        }
        drawn.i = dot(drawn.i, m.geometric) < 0 ? flip_across(drawn.i, m.geometric) : drawn.i;
    }
    const double drawn_density = density(m, bsdf, o, drawn.i);
    drawn.weight = drawn_density > 0 ? evaluate(m, bsdf, o, drawn.i) / drawn_density : dvec3(0);
    return drawn;
}

double density(const Mapped& m, const Bsdf& bsdf, const dvec3& o, const dvec3& i) {
    if (!leaves(m, i)) {
        return 0;
    }
    const double share = specular_share(bsdf, m.q, o);
    double sum = (1 - share) * glm::max(dot(i, m.p), 0.0) / pi;
    if (share > 0) {
        const Bsdf specular = specular_part(bsdf);
        sum += share * (density(specular, m.q, o, i) + density(specular, m.q, o, flip_across(i, m.geometric)));
    }
    return sum;
}

}  // namespace diptych::core::oracle
