// A first vertex as neighbours in space and time see it: enough to evaluate the target function there (target.h), in
// 36 bytes. It is in world space, so that it stays valid when its object has moved.
#ifndef REUSE_SURFACE_H
#define REUSE_SURFACE_H

#include "bsdf/surface_bsdf.h"
#include "restir/target.h"

SHARED_BEGIN

/// Packed: unit vectors are octahedral, colours have a shared exponent.
struct ReuseSurface {
    vec3 position;  // origin of rays that leave the surface
    uint geometric_normal;
    uint normal;
    uint wo;
    uint diffuse;
    uint f0;
    uint rest;  // from the low bits: flags 8, f90 8, alpha 16
};
ASSERT_SIZE(ReuseSurface, 36);

FN uint pack_snorm16(float x) { return uint(int(floor(clamp(x, -1.0f, 1.0f) * 32767.0f + 0.5f)) & 0xffff); }

FN float unpack_snorm16(uint bits) { return float((int(bits) << 16) >> 16) * (1.0f / 32767.0f); }

/// Octahedral map of a unit vector (Cigolle et al. 2014), 16 bits an axis.
FN uint pack_unit_vector(vec3 v) {
    float scale = 1.0f / (abs(v.x) + abs(v.y) + abs(v.z));
    float x = v.x * scale;
    float y = v.y * scale;
    float folded_x = v.z < 0.0f ? (1.0f - abs(y)) * (x < 0.0f ? -1.0f : 1.0f) : x;
    float folded_y = v.z < 0.0f ? (1.0f - abs(x)) * (y < 0.0f ? -1.0f : 1.0f) : y;
    return pack_snorm16(folded_x) | (pack_snorm16(folded_y) << 16);
}

FN vec3 unpack_unit_vector(uint bits) {
    float x = unpack_snorm16(bits & 0xffffu);
    float y = unpack_snorm16(bits >> 16);
    float z = 1.0f - abs(x) - abs(y);
    float fold = max(-z, 0.0f);
    return normalize(vec3(x + (x < 0.0f ? fold : -fold), y + (y < 0.0f ? fold : -fold), z));
}

/// Colours in [0, 1] as three 9-bit fractions of a power of two. A positive channel stays positive.
FN uint pack_color(vec3 color) {
    vec3 c = clamp(color, vec3(0.0f, 0.0f, 0.0f), vec3(1.0f, 1.0f, 1.0f));
    float largest = max(max_component(c), 1.0e-9f);
    uint exponent = clamp((floatBitsToUint(largest) >> 23) + 1u, 96u, 127u);  // of a power of two above all channels
    float scale = 511.0f / uintBitsToFloat(exponent << 23);
    uint x = min(uint(c.x * scale) + (c.x > 0.0f ? 1u : 0u), 511u);
    uint y = min(uint(c.y * scale) + (c.y > 0.0f ? 1u : 0u), 511u);
    uint z = min(uint(c.z * scale) + (c.z > 0.0f ? 1u : 0u), 511u);
    return x | (y << 9) | (z << 18) | ((exponent - 96u) << 27);
}

FN vec3 unpack_color(uint bits) {
    float scale = uintBitsToFloat(((bits >> 27) + 96u) << 23) * (1.0f / 511.0f);
    return vec3(float(bits & 511u), float((bits >> 9) & 511u), float((bits >> 18) & 511u)) * scale;
}

FN ReuseSurface no_reuse_surface() {
    ReuseSurface s;
    s.position = vec3(0.0f, 0.0f, 0.0f);
    s.geometric_normal = 0u;
    s.normal = 0u;
    s.wo = 0u;
    s.diffuse = 0u;
    s.f0 = 0u;
    s.rest = 0u;
    return s;
}

FN bool is_valid(IN(ReuseSurface) s) { return (s.rest & REUSE_SURFACE_VALID) != 0u; }

/// The normal of a surface that neighbours use for the target.
FN vec3 reuse_normal(IN(SurfaceBsdf) bsdf, vec3 wo) {
    if (bsdf.mapped == NORMAL_MAP_SHADING) {
        return bend_toward(bsdf.mapped_normal, bsdf.geometric_normal, MAPPED_COS);
    }
    return bent_normal(bsdf.mapped_normal, bsdf.geometric_normal, wo);
}

FN ReuseSurface pack_reuse_surface(vec3 position, IN(SurfaceBsdf) bsdf, vec3 wo) {
    ReuseSurface s;
    s.position = position;
    s.geometric_normal = pack_unit_vector(bsdf.geometric_normal);
    s.normal = pack_unit_vector(reuse_normal(bsdf, wo));
    s.wo = pack_unit_vector(wo);
    s.diffuse = pack_color(bsdf.parameters.diffuse);
    s.f0 = pack_color(bsdf.parameters.f0);
    float f90 = clamp(max_component(bsdf.parameters.f90), 0.0f, 1.0f);
    uint f90_bits = min(uint(f90 * 255.0f) + (f90 > 0.0f ? 1u : 0u), 255u);
    uint alpha_bits = uint(clamp(bsdf.parameters.alpha, 0.0f, 1.0f) * 65535.0f);
    uint mapped_bits = bsdf.mapped == NORMAL_MAP_SHADING ? REUSE_SURFACE_MAPPED : 0u;
    mapped_bits = bsdf.mapped == NORMAL_MAP_MICROFACET ? REUSE_SURFACE_FACETS : mapped_bits;
    s.rest = REUSE_SURFACE_VALID | mapped_bits | (f90_bits << 8) | (alpha_bits << 16);
    return s;
}

/// Whether neighbours may reuse a surface's reservoir. Where the target widens a lobe, the integrand exceeds the
/// target by the square of the ratio of widths. A point that a neighbour selected by the wide lobe would sometimes be
/// a firefly; material sampling finds such points without fireflies. The same holds for narrow lobes of a microfacet
/// normal map's tangent facet. At grazing views the rounding of wo moves the half vector more, so the limit on alpha
/// rises.
FN bool wants_reuse(IN(SurfaceBsdf) bsdf, vec3 wo) {
    vec3 normal = reuse_normal(bsdf, wo);
    if (bsdf.mapped == NORMAL_MAP_SHADING) {
        normal = specular_normal(normal, bsdf.geometric_normal, wo);
    }
    bool glossy = max(max_component(bsdf.parameters.f0), max_component(bsdf.parameters.f90)) > 0.0f;
    float least = bsdf.mapped == NORMAL_MAP_MICROFACET && glossy ? TARGET_ALPHA_MIN_FACETS : TARGET_ALPHA_MIN;
    return bsdf.parameters.alpha >= least && bsdf.parameters.alpha * dot(normal, wo) >= 0.5f * TARGET_ALPHA_MIN;
}

/// `features` are the bits of scene_features.h that may be needed. Without normal maps their code is dropped.
FN TargetSurface unpack_reuse_surface(IN(ReuseSurface) s, uint features) {
    TargetSurface t;
    t.position = s.position;
    t.geometric_normal = unpack_unit_vector(s.geometric_normal);
    t.normal = unpack_unit_vector(s.normal);
    t.wo = unpack_unit_vector(s.wo);
    t.diffuse = unpack_color(s.diffuse);
    t.f0 = unpack_color(s.f0);
    t.f90 = float((s.rest >> 8) & 255u) * (1.0f / 255.0f);
    t.alpha = max(float(s.rest >> 16) * (1.0f / 65535.0f), TARGET_ALPHA_MIN);
    t.flags = s.rest & ((features & FEATURE_NORMAL_MAPS) != 0u ? 255u : REUSE_SURFACE_VALID);
    t.specular_normal = t.normal;
    if ((t.flags & REUSE_SURFACE_MAPPED) != 0u) {
        t.specular_normal = specular_normal(t.normal, t.geometric_normal, t.wo);
    }
    return t;
}

/// Whether two first vertices are similar enough for reuse to reduce noise: near one plane, with similar normals. The
/// test uses geometry alone, so it introduces no bias. `eye` is the camera's position.
FN bool is_similar(IN(ReuseSurface) a, IN(ReuseSurface) b, vec3 eye) {
    if (!is_valid(a) || !is_valid(b)) {
        return false;
    }
    vec3 normal = unpack_unit_vector(a.normal);
    vec3 apart = b.position - a.position;
    vec3 from_eye = a.position - eye;
    float off_plane = dot(apart, unpack_unit_vector(a.geometric_normal));
    return dot(normal, unpack_unit_vector(b.normal)) > 0.85f &&
           off_plane * off_plane < 0.0025f * dot(from_eye, from_eye);
}

SHARED_END

#endif
