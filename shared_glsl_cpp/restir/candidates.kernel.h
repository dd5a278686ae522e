// The initial reservoir of a first vertex, from light points picked among all lights (restir.kernel.h). This file
// traces no rays.
#ifndef CANDIDATES_KERNEL_H
#define CANDIDATES_KERNEL_H

#include "restir/candidate_picker.kernel.h"
#include "path/path.kernel.h"

/// How often, and how far, a surface's material is sampled for candidates.
struct BsdfCandidates {
    float count;  // number of samples; below 1, the probability of one sample
    float reach;  // metres, of the rays that look for lights
};

/// Narrow lobes are sampled more than once and without limit of distance, because picked lights rarely fall within
/// them. Other lobes are sampled where emitters are near, the roughest only with some probability. There picking is by
/// area, without regard to distance: a near point is picked rarely, and its weight is the inverse of that small
/// probability. Material sampling finds it per solid angle, which bounds its weight by about 1 / count for a point of
/// the lamps' mean radiance. Short rays cost little. On a rougher surface fewer points come near the bound.
FN BsdfCandidates bsdf_candidates(IN(SurfaceBsdf) bsdf, IN(CandidatePicker) picker) {
    BsdfCandidates c;
    c.count = 0.0f;
    c.reach = 0.0f;
    if (constants.resampling.bsdf_candidates != 0u) {
        bool has_lobe = max(max_component(bsdf.parameters.f0), max_component(bsdf.parameters.f90)) > 0.0f &&
                        !bsdf_is_mirror(bsdf.parameters, features());
        bool narrow = has_lobe && bsdf.parameters.alpha < 0.1f;
        bool glossy = has_lobe && bsdf.parameters.alpha < 0.5f;
        float nearby = glossy ? BSDF_CANDIDATES_GLOSSY : BSDF_CANDIDATES_NEARBY;
        c.reach = narrow ? INFINITE_DISTANCE : light_reach();
        c.count = narrow ? float(BSDF_CANDIDATES_NARROW) : (picker.close ? nearby : 0.0f);
    }
    return c;
}

/// Whether material sampling can find the light point.
FN bool is_within(IN(BsdfCandidates) c, vec3 origin, IN(SeenLight) light) {
    float distance = light.distant ? INFINITE_DISTANCE : length(light.end - origin);
    return light.by_chance && MUTANT(CANDIDATE_BEYOND_REACH, distance <= c.reach, true);
}

/// A first vertex that may take its light from a reservoir.
struct FirstSurface {
    bool takes_light;  // false: the other fields are undefined
    SurfaceBsdf bsdf;
    vec3 wo;
    vec3 origin;  // of rays that leave it
    ReuseSurface packed;
    bool reuses;
    Sampler random;
};

/// The first vertex where the camera ray hit.
FN FirstSurface load_first_surface(uvec2 pixel, IN(ResamplingPass) pass, IN(Hit) hit) {
    FirstSurface first;
    first.takes_light = false;
    PathState path = begin_path(pixel, pass.frame);
    first.random = path.random;
    if (hit.instance != NONE && constants.max_depth > 0u) {
        first.wo = -path.direction;
        LOCAL(Instance) instance = load_instances(hit.instance);
        Surface surface = load_surface(hit, instance, path.origin, path.direction);
        LOCAL(Material) material = load_materials(surface.mesh.geometry.material);
        first.bsdf = load_bsdf(surface, instance, material, first.wo);
        if ((material.flags & MATERIAL_UNLIT) == 0u && !bsdf_is_purely_delta(first.bsdf.parameters, features())) {
            first.takes_light = true;
            first.origin = offset_ray(surface.start, first.bsdf.geometric_normal, surface.magnitude);
            first.packed = pack_reuse_surface(first.origin, first.bsdf, first.wo);
            first.reuses = wants_reuse(first.bsdf, first.wo);
        }
    }
    return first;
}

/// The surface that light points are picked for: the packed surface, as neighbours see it. Where no neighbour reuses
/// it, its narrow lobes may miss the true lobes; a white diffuse term is then added, so that the target is positive
/// wherever the BSDF is. Most of these surfaces evaluate the integrand again when they sample their material.
FN TargetSurface picking_surface(IN(FirstSurface) first) {
    TargetSurface s = unpack_reuse_surface(first.packed, features());
    if (!first.reuses) {
        s.diffuse = s.diffuse + vec3(1.0f, 1.0f, 1.0f);
    }
    return s;
}

/// Picks light points and selects one in proportion to target over density.
FN Resampling resample_lights(IN(TargetSurface) surface, IN(CandidatePicker) picker, IN(Sampler) random) {
    Resampling chosen = begin_resampling();
    uint count = constants.light_count > 0u ? constants.resampling.light_candidates : 0u;
    ClusterSteps steps = begin_cluster_steps(random);
    for (uint i = 0u; i < count; i++) {
        uvec4 words = independent_words(random, DIMENSION_CANDIDATE + i);
        uvec4 pick = independent_words(random, DIMENSION_CANDIDATE_PICK + i);
        PickedLight picked;
        if (i < picker.by_power) {
            picked = pick_light_by_power(picker, uvec2(words.x, words.y));
        } else {
            picked = pick_near_light(steps, picker, i - picker.by_power, uvec3(words.x, words.y, pick.w));
        }
        vec2 u = vec2(unit_float(words.z), unit_float(words.w));
        LightPointSample candidate = sample_light_point(picked.id, u, uvec2(pick.y, pick.z));
        if (!(candidate.pdf > 0.0f)) {
            continue;
        }
        float target = unoccluded_target(surface, see_light_point(candidate.point, surface.position, MOMENT_CURRENT));
        add_candidate(chosen, candidate.point, target, target / (picked.picks * candidate.pdf), unit_float(pick.x));
    }
    return chosen;
}

/// The confidence is 1, even for a null sample.
FN Reservoir initial_reservoir(IN(Resampling) chosen) {
    return end_resampling(chosen, 1.0f, MUTANT(CONFIDENCE_BY_SAMPLE, 1.0f, clamp(chosen.target, 0.1f, 10.0f)));
}

/// The target of the final selection: the one that neighbours can evaluate or, without neighbours, the integrand.
FN float candidate_target(IN(FirstSurface) first, IN(SeenLight) light, vec3 f) {
    return first.reuses ? unoccluded_target(unpack_reuse_surface(first.packed, features()), light)
                        : target_of_reflectance(f, light);
}

/// The share of a picked point's weight that material sampling takes over: q p_bsdf / (q p_bsdf + n p_pick), the
/// balance heuristic for q material samples. It is 0 where material sampling cannot find the point.
FN float bsdf_share(IN(FirstSurface) first, IN(CandidatePicker) picker, IN(BsdfCandidates) c, IN(LightPoint) picked,
                    IN(SeenLight) light, float pdf) {
    if (!is_within(c, first.origin, light)) {
        return 0.0f;
    }
    float pdf_bsdf = c.count * light.measure * pdf;
    float pdf_picked = picks_of_light(picker, picked.light) * pdf_light_point(picked);
    return MUTANT(PICKED_KEEPS_ALL, pdf_bsdf / (pdf_bsdf + pdf_picked), 0.0f);
}

/// Removes material sampling's share from a picked point, or requests a ray for that. Material sampling finds a point
/// only if no emitter is in front of it (trace_emitters).
/// Without reuse no ray is needed. A visible point has no emitter in front of it; an occluded point contributes zero.
/// With reuse a neighbour may see a point that is occluded here, and there the shares have to sum to 1. So
/// share_picked traces a ray among the emitters. For a small share r the ray is rarely worthwhile: with probability a
/// = min(1, r / BSDF_SHARE_LEAST) the point loses the share r / a if no emitter is in front of it. The expectation is
/// the same.
FN void share_with_material(IN(FirstSurface) first, IN(CandidatePicker) picker, IN(BsdfCandidates) c,
                            INOUT(Reservoir) reservoir, INOUT(CandidateRequest) request) {
    if (!(c.count > 0.0f) || !(reservoir.weight > 0.0f)) {
        return;
    }
    SeenLight light = see_light_point(reservoir.point, first.origin, MOMENT_CURRENT);
    BsdfValue value = surface_bsdf_eval_pdf(first.bsdf, first.wo, light.direction, features());
    float share = bsdf_share(first, picker, c, reservoir.point, light, value.pdf);
    if (first.reuses && reuses_reservoirs(constants.integrator)) {
        float asked = min(share * (1.0f / BSDF_SHARE_LEAST), 1.0f);
        uvec4 pick = independent_words(first.random, DIMENSION_BSDF_CANDIDATE + 1u);
        if (unit_float(pick.z) < asked) {
            request.needs |= CANDIDATE_SHARES;
            request.share = share / asked;
        }
        return;
    }
    float target = candidate_target(first, light, value.value);
    Resampling chosen = begin_resampling();
    add_reservoir(chosen, reservoir, target, 1.0f - share, 0.0f);
    reservoir = initial_reservoir(chosen);
}

/// Whether the material is sampled, and whether its lobe is narrow, as CANDIDATE_… bits.
FN uint bsdf_candidate_needs(IN(FirstSurface) first, IN(BsdfCandidates) c) {
    uvec4 pick = independent_words(first.random, DIMENSION_BSDF_CANDIDATE + 1u);
    return (unit_float(pick.y) < c.count ? CANDIDATE_SAMPLES_BSDF : 0u) | (c.count > 1.0f ? CANDIDATE_IS_NARROW : 0u);
}

FN bool needs_rays(IN(CandidateRequest) r) {
    return (r.needs & (CANDIDATE_SAMPLES_BSDF | CANDIDATE_SHARES)) != 0u;
}

/// Stores the initial reservoir, before rays, and the surface for neighbours. Returns what share_picked and
/// add_bsdf_candidate still have to do.
FN CandidateRequest resample_candidates(uvec2 pixel, IN(ResamplingPass) pass) {
    uint index = pixel_index(pixel);
    FirstVertex vertex = load_first_vertex(index);
    FirstSurface first = load_first_surface(pixel, pass, vertex.hit);
    Reservoir reservoir = empty_reservoir();
    ReuseSurface kept = no_reuse_surface();
    CandidateRequest request;
    request.pixel = index;
    request.needs = 0u;
    request.share = 0.0f;
    request.near_sum = 0.0f;
    if (first.takes_light) {
        vertex.origin = first.origin;
        store_first_vertex(index, vertex);
        TargetSurface surface = picking_surface(first);
        CandidatePicker picker = begin_candidate_picker(surface);
        BsdfCandidates c = bsdf_candidates(first.bsdf, picker);
        reservoir = initial_reservoir(resample_lights(surface, picker, first.random));
        request.needs = bsdf_candidate_needs(first, c) | (picker.close ? CANDIDATE_IS_CLOSE : 0u);
        request.near_sum = picker.sum;
        share_with_material(first, picker, c, reservoir, request);
        if (first.reuses) {
            kept = first.packed;
        }
    }
    store_reservoir(pass.reservoirs, index, reservoir);
    if (reuses_reservoirs(constants.integrator)) {
        store_reuse_surface(pass.surfaces, index, kept);
    }
    return request;
}

#endif
