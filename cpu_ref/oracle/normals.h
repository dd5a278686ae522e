// How the normals of a point scatter: those of a surface without a map, or a map's by either model.
#pragma once

#include <variant>

#include "oracle/facets.h"
#include "oracle/mapped.h"

namespace diptych::core::oracle {

/// The models of normal maps of docs/integrand.md.
enum class NormalMaps {
    shading,     // the mapped normal takes the place of the surface's
    microfacet,  // the mapped normal is a facet of a microsurface
};

/// What `evaluate`, `sample` and `density` of facets.h and mapped.h are of. A surface without a map is flat facets.
using Normals = std::variant<Facets, Mapped>;

/// n and mapped: mesh and mapped normal, the same one where there is no map, n on the side of `geometric`.
inline Normals make_normals(NormalMaps model, const dvec3& geometric, const dvec3& n, const dvec3& mapped,
                            const dvec3& o) {
    if (model == NormalMaps::microfacet || mapped == n) {
        return make_facets(geometric, n, mapped, o);
    }
    return make_mapped(geometric, mapped, o);
}

/// The normal that a picture of normals shows: the mapped one, the bent one where there is no map.
inline dvec3 shown_normal(const Normals& normals) {
    return std::visit([](const auto& kind) { return kind.p; }, normals);
}

inline dvec3 evaluate(const Normals& normals, const Bsdf& bsdf, const dvec3& o, const dvec3& i) {
    return std::visit([&](const auto& kind) { return evaluate(kind, bsdf, o, i); }, normals);
}

inline Scattered sample(const Normals& normals, const Bsdf& bsdf, const dvec3& o, bool only_mirror, Random& random) {
    return std::visit([&](const auto& kind) { return sample(kind, bsdf, o, only_mirror, random); }, normals);
}

inline double density(const Normals& normals, const Bsdf& bsdf, const dvec3& o, const dvec3& i) {
    return std::visit([&](const auto& kind) { return density(kind, bsdf, o, i); }, normals);
}

}  // namespace diptych::core::oracle
