// The first vertex's initial reservoir, from light points that are picked among all lights (restir.kernel.h). Nothing is traced here.
#ifndef CANDIDATES_KERNEL_H
#define CANDIDATES_KERNEL_H

#include "restir/candidate_picker.kernel.h"
#include "path/path.kernel.h"

/// How a surface's material is sampled for candidates.
struct BsdfCandidates {
    float count;  // whole, or below 1 the probability of one
    float reach;  // metres, along which they find lights
};

/// Narrow lobes more than once, and as far as they reach: lights are seldom picked within them. Others where emitters are close by, and the
/// roughest of them now and then: a point of those is picked for its area and not for being near, so seldom and with a weight as large as
/// that is seldom. That it might be found by its solid angle bounds it where it is about as bright as the scene's lamps are, and
/// short rays are cheap. The bound is 1 / count, and what comes near it is rarer the rougher the surface is.
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

/// Whether material sampling could have found the light point.
FN bool is_within(IN(BsdfCandidates) c, vec3 origin, IN(SeenLight) light) {
    float distance = light.distant ? INFINITE_DISTANCE : length(light.end - origin);
    return light.by_chance && MUTANT(CANDIDATE_BEYOND_REACH, distance <= c.reach, true);
}

/// A surface that takes its light from a reservoir.
struct FirstSurface {
    bool takes_light;  // else the rest means nothing
    SurfaceBsdf bsdf;
    vec3 wo;
    vec3 origin;  // of its rays
    ReuseSurface packed;
    bool reuses;
    Sampler random;
};

/// What a camera's ray met.
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

/// What light points are picked for: the surface as others see it, and, where none will, white paper behind it, lest the true lobes be where
/// its narrow ones are not. Most such surfaces look at the integrand once more when they sample their material.
FN TargetSurface picking_surface(IN(FirstSurface) first) {
    TargetSurface s = unpack_reuse_surface(first.packed, features());
    if (!first.reuses) {
        s.diffuse = s.diffuse + vec3(1.0f, 1.0f, 1.0f);
    }
    return s;
}

/// Light points, one kept in proportion to the target.
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

/// Of confidence 1 whatever it holds.
FN Reservoir initial_reservoir(IN(Resampling) chosen) {
    return end_resampling(chosen, 1.0f, MUTANT(CONFIDENCE_BY_SAMPLE, 1.0f, clamp(chosen.target, 0.1f, 10.0f)));
}

/// The target of what is chosen in the end: the one that others can evaluate, or, where none will, the integrand itself.
FN float candidate_target(IN(FirstSurface) first, IN(SeenLight) light, vec3 f) {
    return first.reuses ? unoccluded_target(unpack_reuse_surface(first.packed, features()), light)
                        : target_of_reflectance(f, light);
}

/// How much of its weight a picked point gives to sampling the material, which is done q times, by the balance heuristic:
/// q p_bsdf / (q p_bsdf + n p_pick), where that may find it.
FN float bsdf_share(IN(FirstSurface) first, IN(CandidatePicker) picker, IN(BsdfCandidates) c, IN(LightPoint) picked,
                    IN(SeenLight) light, float pdf) {
    if (!is_within(c, first.origin, light)) {
        return 0.0f;
    }
    float pdf_bsdf = c.count * light.measure * pdf;
    float pdf_picked = picks_of_light(picker, picked.light) * pdf_light_point(picked);
    return MUTANT(PICKED_KEEPS_ALL, pdf_bsdf / (pdf_bsdf + pdf_picked), 0.0f);
}

/// Takes from a picked point what sampling the material is to add, or leaves a request for it. Sampling finds a point if no emitter is before
/// it (trace_emitters). Where nobody else takes the reservoir over, that need not be asked: of a point that is seen it is so, and one that is
/// not weighs nothing in the end. But others may see what is hidden from here, and to them the shares have to add up to 1: there a ray among
/// the emitters asks. Where the share r is small it seldom pays to look: with probability a = min(1, r / BSDF_SHARE_LEAST) the point gives up
/// r / a if no emitter is before it, which comes to the same.
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

/// How often the material is to be sampled.
FN uint bsdf_candidate_needs(IN(FirstSurface) first, IN(BsdfCandidates) c) {
    uvec4 pick = independent_words(first.random, DIMENSION_BSDF_CANDIDATE + 1u);
    return (unit_float(pick.y) < c.count ? CANDIDATE_SAMPLES_BSDF : 0u) | (c.count > 1.0f ? CANDIDATE_IS_NARROW : 0u);
}

FN bool needs_rays(IN(CandidateRequest) r) {
    return (r.needs & (CANDIDATE_SAMPLES_BSDF | CANDIDATE_SHARES)) != 0u;
}

/// The reservoir, for now, and the surface for others. Returns what share_picked and add_bsdf_candidate have to do, if anything.
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
