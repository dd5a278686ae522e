// The first vertex's initial reservoir, from light points that are picked among all lights (restir.kernel.h). Nothing is traced here.
#ifndef CANDIDATES_KERNEL_H
#define CANDIDATES_KERNEL_H

#include "light_picker.kernel.h"
#include "path.kernel.h"

/// The target without visibility, per uv.
FN float unoccluded_target(IN(TargetSurface) s, IN(SeenLight) light) {
    return light.measure * luminance(target_reflectance(s, light.direction) * light.radiance);
}

/// How a surface's material is sampled for candidates.
struct BsdfCandidates {
    float count;  // whole, or below 1 the probability of one
    float reach;  // metres, along which they find lights
};

/// Narrow lobes more than once, and as far as they reach: lights are seldom picked within them, and nobody else looks for them. Others now
/// and then where emitters are close by: a point of those is picked for its area and not for being near, so seldom and with a weight as
/// large as that is seldom. That it might be found by its solid angle bounds it where it is visible and about as bright as the scene's lamps
/// are, and short rays are cheap. The bound is 1 / count, and what comes near it is rarer the rougher the surface is.
FN BsdfCandidates bsdf_candidates(IN(SurfaceBsdf) bsdf, IN(LightPicker) picker) {
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
    TargetSurface s = unpack_reuse_surface(first.packed);
    if (!first.reuses) {
        s.diffuse = s.diffuse + vec3(1.0f, 1.0f, 1.0f);
    }
    return s;
}

/// Light points, one kept in proportion to the target.
FN Resampling resample_lights(IN(TargetSurface) surface, IN(LightPicker) picker, IN(Sampler) random) {
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
    return first.reuses ? unoccluded_target(unpack_reuse_surface(first.packed), light)
                        : light.measure * luminance(f * light.radiance);
}

/// What was picked, less what the balance heuristic gives to sampling the material, which is done q times: it keeps
/// n p_pick / (q p_bsdf + n p_pick). Whether the point is seen does not matter. If it is, sampling the material may find it, as no emitter
/// is before it; if it is not, it weighs nothing in the end.
FN Reservoir share_with_material(IN(FirstSurface) first, IN(LightPicker) picker, IN(BsdfCandidates) c,
                                 IN(Reservoir) picked) {
    if (!(c.count > 0.0f) || !(picked.weight > 0.0f)) {
        return picked;
    }
    SeenLight light = see_light_point(picked.point, first.origin, MOMENT_CURRENT);
    BsdfValue value = surface_bsdf_eval_pdf(first.bsdf, first.wo, light.direction, features());
    float kept = 1.0f;
    if (is_within(c, first.origin, light)) {
        float pdf_bsdf = c.count * light.measure * value.pdf;
        float pdf_picked = picks_of_light(picker, picked.point.light) * pdf_light_point(picked.point);
        kept = MUTANT(PICKED_KEEPS_ALL, pdf_picked / (pdf_bsdf + pdf_picked), 1.0f);
    }
    float target = candidate_target(first, light, value.value);
    Resampling chosen = begin_resampling();
    add_candidate(chosen, picked.point, target, kept * target * picked.weight, 0.0f);
    return initial_reservoir(chosen);
}

/// How often the material is to be sampled.
FN uint bsdf_candidate_needs(IN(FirstSurface) first, IN(BsdfCandidates) c) {
    uvec4 pick = independent_words(first.random, DIMENSION_BSDF_CANDIDATE + 1u);
    return (unit_float(pick.y) < c.count ? CANDIDATE_SAMPLES_BSDF : 0u) | (c.count > 1.0f ? CANDIDATE_IS_NARROW : 0u);
}

FN bool needs_rays(IN(CandidateRequest) r) {
    return (r.needs & CANDIDATE_SAMPLES_BSDF) != 0u;
}

/// The reservoir, for now, and the surface for others. Returns what add_bsdf_candidate has to do, if anything.
FN CandidateRequest resample_candidates(uvec2 pixel, IN(ResamplingPass) pass) {
    uint index = pixel_index(pixel);
    FirstVertex vertex = load_first_vertex(index);
    FirstSurface first = load_first_surface(pixel, pass, vertex.hit);
    Reservoir reservoir = empty_reservoir();
    ReuseSurface kept = no_reuse_surface();
    CandidateRequest request;
    request.pixel = index;
    request.needs = 0u;
    request.near_sum = 0.0f;
    if (first.takes_light) {
        vertex.origin = first.origin;
        store_first_vertex(index, vertex);
        TargetSurface surface = picking_surface(first);
        LightPicker picker = begin_light_picker(surface);
        BsdfCandidates c = bsdf_candidates(first.bsdf, picker);
        Reservoir picked = initial_reservoir(resample_lights(surface, picker, first.random));
        reservoir = share_with_material(first, picker, c, picked);
        request.needs = bsdf_candidate_needs(first, c) | (picker.close ? CANDIDATE_IS_CLOSE : 0u);
        request.near_sum = picker.sum;
        if (first.reuses) {
            kept = first.packed;
        }
    }
    store_reservoir(pass.reservoirs, index, reservoir);
    if (constants.integrator == INTEGRATOR_RESTIR) {
        store_reuse_surface(pass.surfaces, index, kept);
    }
    return request;
}

#endif
