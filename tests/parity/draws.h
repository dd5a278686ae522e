// Draws of every sampler, in the shared dialect: what level 1 asks of the device.
#ifndef DRAWS_H
#define DRAWS_H

#include "leaves.h"

SHARED_BEGIN

CONST uint DRAW_COSINE = 0u;
CONST uint DRAW_HEMISPHERE = 1u;
CONST uint DRAW_SPHERE = 2u;
CONST uint DRAW_DISK = 3u;
CONST uint DRAW_GGX = 4u;
CONST uint DRAW_BLINN_PHONG = 5u;
CONST uint DRAW_BSDF = 6u;
CONST uint DRAW_SURFACE = 7u;
CONST uint DRAW_TRIANGLE = 8u;
CONST uint DRAW_ALIAS = 9u;

CONST uint DRAW_COLUMNS = 64u;  // of the alias table

struct DrawSetup {
    uint kind;
    uint seed;
    vec3 wo;
    SurfaceBsdf surface;
    vec3 vertex;
    vec3 edge_1;
    vec3 edge_2;
    AliasEntry table[DRAW_COLUMNS];
};

/// A point, and its pdf: 0 for a null sample, negative for a delta.
struct Drawn {
    vec3 point;
    float pdf;
};

FN Drawn draw_nothing() {
    Drawn d;
    d.point = vec3(0.0f, 0.0f, 1.0f);
    d.pdf = 0.0f;
    return d;
}

FN Drawn draw_facet(IN(DrawSetup) s, vec2 u) {
    Drawn d = draw_nothing();
    float alpha = s.surface.parameters.alpha;
    vec3 h = s.kind == DRAW_GGX ? sample_ggx_visible_normal(s.wo, alpha, u) : sample_blinn_phong_normal(alpha, u);
    float o_dot_h = dot(s.wo, h);
    vec3 wi = normalize(2.0f * o_dot_h * h - s.wo);
    if (!(o_dot_h > 0.0f) || !(wi.z > 0.0f)) {
        return d;
    }
    d.point = wi;
    vec3 half_vector = normalize(s.wo + wi);
    d.pdf = s.kind == DRAW_GGX ? pdf_ggx_solid_angle(s.wo, half_vector, alpha)
                               : pdf_blinn_phong_solid_angle(dot(s.wo, half_vector), half_vector, alpha);
    return d;
}

FN Drawn draw_bsdf(IN(DrawSetup) s, vec2 u_lobe, vec2 u) {
    Drawn d;
    BsdfSample r;
    if (s.kind == DRAW_BSDF) {
        r = bsdf_sample_local(s.surface.parameters, s.wo, u_lobe.x, u, 0xffffffffu);
    } else {
        r = surface_bsdf_sample(s.surface, s.wo, u_lobe, u, 0xffffffffu);
    }
    d.point = r.direction;
    d.pdf = r.delta != 0u ? -r.pdf : r.pdf;
    return d;
}

FN Drawn draw_sample(IN(DrawSetup) s, uint index) {
    uvec4 bits = pcg4d(uvec4(index, s.seed, 0x2545f491u, 1u));
    uvec4 more = pcg4d(uvec4(index, s.seed, 0x2545f491u, 2u));
    vec2 u = vec2(unit_float(bits.x), unit_float(bits.y));
    vec2 u_lobe = vec2(unit_float(more.x), unit_float(more.y));
    Drawn d = draw_nothing();
    if (s.kind == DRAW_COSINE) {
        d.point = sample_cosine_hemisphere(u);
        d.pdf = pdf_cosine_hemisphere_solid_angle(d.point.z);
    } else if (s.kind == DRAW_HEMISPHERE) {
        d.point = sample_uniform_hemisphere(u);
        d.pdf = pdf_uniform_hemisphere_solid_angle();
    } else if (s.kind == DRAW_SPHERE) {
        d.point = sample_uniform_sphere(u);
        d.pdf = pdf_uniform_sphere_solid_angle();
    } else if (s.kind == DRAW_DISK) {
        vec2 disk = sample_disk_concentric(u);
        d.point = vec3(disk.x, disk.y, 0.0f);
        d.pdf = INV_PI;
    } else if (s.kind == DRAW_TRIANGLE) {
        TriangleSample t = sample_triangle_solid_angle(vec3(0.0f, 0.0f, 0.0f), s.vertex, s.edge_1, s.edge_2, u);
        d.point = vec3(t.barycentrics.x, t.barycentrics.y, 0.0f);
        d.pdf = t.pdf;
    } else if (s.kind == DRAW_ALIAS) {
        uint column = alias_column(bits.x, DRAW_COLUMNS);
        d.point = vec3(float(alias_pick(s.table[column], column, bits.y)), 0.0f, 0.0f);
        d.pdf = 1.0f;
    } else if (s.kind == DRAW_GGX || s.kind == DRAW_BLINN_PHONG) {
        d = draw_facet(s, u);
    } else {
        d = draw_bsdf(s, u_lobe, u);
    }
    return d;
}

SHARED_END

#endif
