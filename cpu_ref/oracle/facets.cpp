#include "oracle/facets.h"

#include <cmath>

namespace diptych::core::oracle {

namespace {

constexpr double least_view_cosine = 1e-3;
constexpr double least_facet_cosine = 0.01;

double above(double x) {
    return glm::max(x, 0.0);
}

dvec3 bend(const dvec3& n, const dvec3& geometric, const dvec3& o) {
    if (dot(o, n) >= least_view_cosine) {
        return n;
    }
    const dvec3 bent = with_cosine(n, o, least_view_cosine);
    return dot(bent, geometric) > 0 ? bent : geometric;
}

/// The least rotation that takes `from` to `to`, applied to v (Rodrigues' formula).
dvec3 turn(const dvec3& v, const dvec3& from, const dvec3& to) {
    const dvec3 axis = cross(from, to);
    const double c = dot(from, to);
    return 1 + c > 0 ? v * c + cross(axis, v) + axis * (dot(axis, v) / (1 + c)) : v;
}

double visible_share(const Facets& f, const dvec3& w) {
    const double p = above(dot(w, f.p));
    return p > 0 ? p / (p + above(dot(w, f.t)) * f.sine) : 0;
}

double masking(const Facets& f, const dvec3& w) {
    const double projected = above(dot(w, f.p)) + above(dot(w, f.t)) * f.sine;
    return projected > 0 ? glm::min(1.0, above(dot(w, f.g)) * f.cosine / projected) : 0;
}

bool leaves(const Facets& f, const dvec3& i) {
    return f.is_flat() ? dot(i, f.geometric) > 0
                       : dot(i, f.geometric) > least_light_cosine && dot(i, f.g) > least_light_cosine;
}

Scattered draw(const Facets& f, const Bsdf& bsdf, const dvec3& o, bool only_mirror, Random& random) {
    return only_mirror ? sample_mirror(bsdf, f.p, o) : sample(bsdf, f.p, o, random);
}

}  // namespace

dvec3 held_above(const dvec3& p, const dvec3& axis) {
    return dot(p, axis) < least_facet_cosine ? with_cosine(p, axis, least_facet_cosine) : p;
}

Facets make_facets(const dvec3& geometric, const dvec3& n, const dvec3& mapped, const dvec3& o) {
    Facets f;
    f.geometric = geometric;
    f.g = bend(n, geometric, o);
    f.p = f.g;
    if (mapped == n) {
        return f;
    }
    f.p = held_above(turn(mapped, n, f.g), f.g);
    const dvec3 across = f.p - dot(f.p, f.g) * f.g;
    f.sine = length(across);
    f.cosine = dot(f.p, f.g);
    if (f.sine < 1e-9) {
        f.p = f.g;
        f.sine = 0;
        f.cosine = 1;
        return f;
    }
    f.t = -across / f.sine;
    return f;
}

dvec3 evaluate(const Facets& f, const Bsdf& bsdf, const dvec3& o, const dvec3& i) {
    if (!leaves(f, i)) {
        return dvec3(0);
    }
    if (f.is_flat()) {
        return evaluate(bsdf, f.g, o, i);
    }
    const double share = visible_share(f, o);
    const auto off_facet = [&](const dvec3& seen) {
        dvec3 value = masking(f, i) * evaluate(bsdf, f.p, seen, i) + evaluate(bsdf, f.p, seen, flip_across(i, f.g));
        if (dot(i, f.t) > 0) {
            const dvec3 caught = flip_across(i, f.t);
            value += (1 - masking(f, caught)) * evaluate(bsdf, f.p, seen, caught);
        }
        return value;
    };
    dvec3 value = share * off_facet(o);
    if (share < 1) {
        value += (1 - share) * off_facet(flip_across(o, f.t));
    }
    return value;
}

Scattered sample(const Facets& f, const Bsdf& bsdf, const dvec3& o, bool only_mirror, Random& random) {
    Scattered drawn;
    if (f.is_flat()) {
        drawn = draw(f, bsdf, o, only_mirror, random);
    } else {
        const bool meets_p = random.uniform() < visible_share(f, o);
        drawn = draw(f, bsdf, meets_p ? o : flip_across(o, f.t), only_mirror, random);
        if (dot(drawn.i, f.g) < 0) {
            drawn.i = flip_across(drawn.i, f.g);
        } else if (random.uniform() >= masking(f, drawn.i)) {
            drawn.i = flip_across(drawn.i, f.t);
        }
    }
    if (!leaves(f, drawn.i)) {
        drawn.weight = dvec3(0);
    }
    return drawn;
}

double density(const Facets& f, const Bsdf& bsdf, const dvec3& o, const dvec3& i) {
    if (!leaves(f, i)) {
        return 0;
    }
    if (f.is_flat()) {
        return density(bsdf, f.g, o, i);
    }
    const double share = visible_share(f, o);
    const auto off_facet = [&](const dvec3& seen) {
        const double caught = dot(i, f.t) > 0 ? 1 - masking(f, flip_across(i, f.t)) : 0;
        return masking(f, i) * density(bsdf, f.p, seen, i) + density(bsdf, f.p, seen, flip_across(i, f.g)) +
               (caught > 0 ? caught * density(bsdf, f.p, seen, flip_across(i, f.t)) : 0);
    };
    return share * off_facet(o) + (share < 1 ? (1 - share) * off_facet(flip_across(o, f.t)) : 0);
}

}  // namespace diptych::core::oracle
