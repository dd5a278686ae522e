// Measured: the microfacet models, the surface in its own frame, and surfaces under a normal map.
#ifndef MEASURED_MICROFACETS_H
#define MEASURED_MICROFACETS_H

#include "measured_values.h"

SHARED_BEGIN

/// x 0-2 h, 3 alpha -> y 0 D.
FN void measure_ggx_d(IN(MeasuredInput) p, INOUT(MeasuredOutput) o) {
    o.y[0] = ggx_d(measured_vec3(p, 0u), p.x[3]);
}

FN void measure_blinn_phong_d(IN(MeasuredInput) p, INOUT(MeasuredOutput) o) {
    o.y[0] = blinn_phong_d(measured_vec3(p, 0u), p.x[3]);
}

/// x 0-2 wo, 3-5 wi, 6 alpha -> y 0 G1(wo), 1 G2, 2 G2/G1(wo).
FN void measure_ggx_masking(IN(MeasuredInput) p, INOUT(MeasuredOutput) o) {
    vec3 wo = measured_vec3(p, 0u);
    vec3 wi = measured_vec3(p, 3u);
    o.y[0] = ggx_g1(wo, p.x[6]);
    o.y[1] = ggx_g2(wo, wi, p.x[6]);
    o.y[2] = ggx_weight(wo, wi, p.x[6]);
}

/// x 0-2 wo, 3 alpha, 4-5 u; n 0 model -> y 0-2 facet, 3-5 direction, 6 reflection without Fresnel, 7 pdf; n 0: 0 for a
/// null sample.
FN void measure_reflect(IN(MeasuredInput) p, INOUT(MeasuredOutput) o) {
    vec3 wo = measured_vec3(p, 0u);
    float alpha = p.x[3];
    vec2 u = vec2(p.x[4], p.x[5]);
    bool blinn_phong = p.n[0] == BRDF_BLINN_PHONG;
    vec3 h = blinn_phong ? sample_blinn_phong_normal(alpha, u) : sample_ggx_visible_normal(wo, alpha, u);
    float o_dot_h = dot(wo, h);
    vec3 wi = normalize(2.0f * o_dot_h * h - wo);
    give_vec3(o, 0u, h);
    give_vec3(o, 3u, wi);
    if (!(o_dot_h > 0.0f) || !(wi.z > COS_MIN)) {
        return;
    }
    vec3 sum = wo + wi;
    float sum_length = length(sum);
    vec3 middle = sum / sum_length;
    o.n[0] = 1u;
    o.y[6] = blinn_phong ? blinn_phong_eval(wo, wi, middle, alpha) : ggx_eval(wo, wi, middle, alpha);
    o.y[7] = blinn_phong ? pdf_blinn_phong_solid_angle(0.5f * sum_length, middle, alpha)
                         : pdf_ggx_solid_angle(wo, middle, alpha);
}

/// White, by x: metallic 1 is a metal, 0 a plastic; below 0 it is diffuse alone.
FN BsdfParameters measured_material(float metallic, float roughness, uint model) {
    float specular = metallic < 0.0f ? 0.0f : 1.0f;
    return bsdf_parameters(vec3(1.0f, 1.0f, 1.0f), metallic, roughness, 0.04f, specular, vec3(1.0f, 1.0f, 1.0f), model);
}

/// x 0-2 wo, 3 roughness, 4 metallic, 5-7 u; n 0 model -> y 0-2 direction, 3 weight, 4 pdf, 5 and 6 value and pdf of
/// eval there; n 0 delta, 1 lobe.
FN void measure_bsdf_sample(IN(MeasuredInput) p, INOUT(MeasuredOutput) o) {
    vec3 wo = measured_vec3(p, 0u);
    BsdfParameters b = measured_material(p.x[4], p.x[3], p.n[0]);
    BsdfSample s = bsdf_sample_local(b, wo, p.x[5], vec2(p.x[6], p.x[7]), 0xffffffffu);
    give_vec3(o, 0u, s.direction);
    o.y[3] = s.weight.x;
    o.y[4] = s.pdf;
    BsdfValue v = bsdf_eval_pdf_local(b, wo, s.direction, 0xffffffffu);
    o.y[5] = v.value.x;
    o.y[6] = v.pdf;
    o.n[0] = s.delta;
    o.n[1] = s.lobe;
}

/// x 0-2 wo, 3-5 wi, 6 roughness, 7 metallic; n 0 model -> y 0 f cos, 1 pdf.
FN void measure_bsdf_eval(IN(MeasuredInput) p, INOUT(MeasuredOutput) o) {
    BsdfParameters b = measured_material(p.x[7], p.x[6], p.n[0]);
    BsdfValue v = bsdf_eval_pdf_local(b, measured_vec3(p, 0u), measured_vec3(p, 3u), 0xffffffffu);
    o.y[0] = v.value.x;
    o.y[1] = v.pdf;
}

/// On the plane z = 0: x 0-2 wo, 3-5 interpolated normal, 6-8 mapped normal, 9 roughness, 10 metallic, 11-14 u; n 0: 1
/// for a map -> y 0-2 direction, 3 weight, 4 pdf, 5 and 6 value and pdf of eval there; n 0 delta.
FN void measure_mapped_surface(IN(MeasuredInput) p, INOUT(MeasuredOutput) o) {
    SurfaceBsdf s;
    s.parameters = measured_material(p.x[10], p.x[9], BRDF_GGX);
    s.geometric_normal = vec3(0.0f, 0.0f, 1.0f);
    s.shading_normal = measured_vec3(p, 3u);
    s.mapped_normal = measured_vec3(p, 6u);
    s.mapped = p.n[0];
    vec3 wo = measured_vec3(p, 0u);
    BsdfSample r = surface_bsdf_sample(s, wo, vec2(p.x[11], p.x[12]), vec2(p.x[13], p.x[14]), 0xffffffffu);
    give_vec3(o, 0u, r.direction);
    o.y[3] = r.weight.x;
    o.y[4] = r.pdf;
    BsdfValue v = surface_bsdf_eval_pdf(s, wo, r.direction, 0xffffffffu);
    o.y[5] = v.value.x;
    o.y[6] = v.pdf;
    o.n[0] = r.delta;
}

SHARED_END

#define MEASURED_MICROFACETS(X)                                                                                        \
    X(ggx_d)                                                                                                           \
    X(blinn_phong_d)                                                                                                   \
    X(ggx_masking)                                                                                                     \
    X(reflect)                                                                                                         \
    X(bsdf_sample)                                                                                                     \
    X(bsdf_eval)                                                                                                       \
    X(mapped_surface)

#endif
