// ReSTIR direct light (Bitterli et al. 2020) in its unbiased GRIS form (Lin et al. 2022), as passes over the film: `first hits` traces
// the camera's rays; `candidates` resamples light points for what they met, in passes that pick lights, sample materials where that
// pays, and test what is seen if the target asks; `temporal` merges what the same surface had a frame before; `spatial` merges what
// neighbours have; `shadows` asks whether the point that came out is seen; `shade` takes the first vertex's direct light from it and
// goes on as a path. `ris` is all of them but the two that merge.
//
// Passes that trace a ray of every pixel do little else: a device that traverses in its shaders' own registers has more rays in
// flight then.
//
// One frame is one sample of every pixel. The first-vertex hits and the reservoirs lie in memory between passes (hooks.md); a set is
// one whole film of them.
#ifndef RESTIR_KERNEL_H
#define RESTIR_KERNEL_H

#include "candidates.kernel.h"
#include "resampled_path.kernel.h"
#include "reuse_passes.kernel.h"

/// The light point, if any, that a ray found; `direction` is the ray's.
FN LightPoint light_point_of_hit(IN(Hit) hit, vec3 direction) {
    LightPoint y = no_light_point();
    if (hit.instance == NONE) {
        y.light = constants.emissive_triangle_count + constants.punctual_light_count;
        y.uv = direction_uv(direction);
        return y;
    }
    uint slot = load_instances(hit.instance).first_emitter_slot;
    if (feature(FEATURE_EMISSIVE) && slot != NONE) {
        uint first = load_emitter_slots(slot + hit.geometry);
        if (first != NONE) {
            y.light = first + hit.primitive;
            y.uv = hit.barycentrics;
        }
    }
    return y;
}

/// What sampling the material finds, if anything, with the density of finding it so.
FN LightPointSample find_light_by_bsdf(IN(FirstSurface) first, IN(LightPicker) picker, INOUT(uint) rays) {
    LightPointSample found;
    found.point = no_light_point();
    found.pdf = 0.0f;
    uvec4 words = independent_words(first.random, DIMENSION_BSDF_CANDIDATE);
    BsdfSample next = surface_bsdf_sample(first.bsdf, first.wo, vec2(unit_float(words.x), unit_float(words.y)),
                                          vec2(unit_float(words.z), unit_float(words.w)), features());
    if (!(next.pdf > 0.0f) || next.delta != 0u) {
        return found;
    }
    rays += 1u;
    BsdfCandidate c = bsdf_candidate(first.bsdf, picker);
    Hit hit = trace_within(first.origin, next.direction, c.reach, ray_alpha_key(first.random, 0x40000000u));
    if (hit.instance == NONE && c.reach < INFINITE_DISTANCE) {
        return found;
    }
    LightPoint y = light_point_of_hit(hit, next.direction);
    if (y.light < constants.light_count) {
        SeenLight light = see_light_point(y, first.origin, MOMENT_CURRENT);
        found.point = y;
        found.pdf = is_within(c, first.origin, light) ? c.probability * next.pdf * light.measure : 0.0f;
    }
    return found;
}

/// The target of what is chosen in the end: the one that others can evaluate, or, where none will, the integrand itself.
FN float candidate_target(IN(FirstSurface) first, IN(TargetSurface) surface, IN(SeenLight) light) {
    if (first.reuses || !(light.measure > 0.0f)) {
        return unoccluded_target(surface, light);
    }
    vec3 f = surface_bsdf_eval(first.bsdf, first.wo, light.direction, features());
    return light.measure * luminance(f * light.radiance);
}

/// Adds what sampling the material finds to what picking lights found.
FN void add_bsdf_candidate(IN(CandidateRequest) request, IN(ResamplingPass) pass) {
    uint index = request.pixel;
    uvec2 pixel = uvec2(index % constants.size.x, index / constants.size.x);
    FirstVertex vertex = load_first_vertex(index);
    FirstSurface first = load_first_surface(pixel, pass, vertex.hit);
    TargetSurface surface = unpack_reuse_surface(first.packed);
    LightPicker picker = resume_light_picker(surface, request);
    Reservoir picked = load_reservoir(pass.reservoirs, index);
    Resampling chosen = begin_resampling();
    if (picked.weight > 0.0f) {
        SeenLight light = see_light_point(picked.point, first.origin, MOMENT_CURRENT);
        float kept = 1.0f;
        if ((request.needs & CANDIDATE_TESTS_PICKED) != 0u) {
            vertex.rays += 1u;
            // Past stochastic alpha by a throw of its own: the target's is for the point, and would be asked twice.
            uint key = MUTANT(CANDIDATE_ALPHA_SHARED, ray_alpha_key(first.random, 0x40000001u), visibility_key(picked.point));
            bool seen = MUTANT(BSDF_CANDIDATE_BLIND, !is_light_hidden(first.origin, light, key), true);
            float share = bsdf_share(first, picker, picked.point, light);
            kept -= seen ? MUTANT(CANDIDATE_SHARE_UNDIVIDED, max(share, BSDF_SHARE_LEAST), share) : 0.0f;
        }
        float target = candidate_target(first, surface, light);
        add_candidate(chosen, picked.point, target, kept * target * picked.weight, 0.0f);
    }
    if ((request.needs & CANDIDATE_SAMPLES_BSDF) != 0u) {
        LightPointSample found = find_light_by_bsdf(first, picker, vertex.rays);
        if (found.pdf > 0.0f) {
            SeenLight light = see_light_point(found.point, first.origin, MOMENT_CURRENT);
            float target = candidate_target(first, surface, light);
            float pdf_picked = picks_of_light(picker, found.point.light) * pdf_light_point(found.point);
            uvec4 pick = independent_words(first.random, DIMENSION_BSDF_CANDIDATE + 1u);
            add_candidate(chosen, found.point, target, target / (found.pdf + pdf_picked), unit_float(pick.x));
        }
    }
    store_first_vertex(index, vertex);
    store_reservoir(pass.reservoirs, index, initial_reservoir(chosen));
}

/// The camera's ray.
FN void find_first_vertex(uvec2 pixel, IN(ResamplingPass) pass) {
    PathState path = begin_path(pixel, pass.frame);
    FirstVertex vertex;
    vertex.hit = trace_closest(path.origin, path.direction, next_ray_key(path));
    vertex.origin = vec3(0.0f, 0.0f, 0.0f);
    vertex.rays = 0u;
    vertex.occluded = 0u;
    store_first_vertex(pixel_index(pixel), vertex);
}

/// An initial reservoir keeps only what is seen.
FN void test_candidate(uvec2 pixel, IN(ResamplingPass) pass) {
    uint index = pixel_index(pixel);
    Reservoir reservoir = load_reservoir(pass.reservoirs, index);
    if (!(reservoir.weight > 0.0f)) {
        return;
    }
    FirstVertex vertex = load_first_vertex(index);
    SeenLight light = see_light_point(reservoir.point, vertex.origin, MOMENT_CURRENT);
    vertex.rays += 1u;
    store_first_vertex(index, vertex);
    if (is_light_occluded(vertex.origin, light, reservoir.point, MOMENT_CURRENT)) {
        reservoir = empty_reservoir();
        reservoir.confidence = MUTANT(CULL_TAKES_CONFIDENCE, 1.0f, 0.0f);
        store_reservoir(pass.reservoirs, index, reservoir);
    }
}

/// Whether the point that a reservoir ended with is seen from its first vertex. Where the target has visibility, it is.
FN void trace_shadow_of_chosen(uvec2 pixel, IN(ResamplingPass) pass) {
    uint index = pixel_index(pixel);
    Reservoir chosen = load_reservoir(pass.reservoirs, index);
    if (!(chosen.weight > 0.0f)) {
        return;
    }
    FirstVertex vertex = load_first_vertex(index);
    SeenLight light = see_light_point(chosen.point, vertex.origin, MOMENT_CURRENT);
    Sampler random = make_sampler(pixel, pass.frame, constants.seed, constants.sampler_kind, constants.sample_count);
    vertex.occluded = is_light_hidden(vertex.origin, light, ray_alpha_key(random, 1u)) ? 1u : 0u;
    vertex.rays += 1u;
    store_first_vertex(index, vertex);
    bool hands_on = MUTANT(FINAL_CULL, constants.resampling.visibility != VISIBILITY_BIASED_FINAL, false);
    if (vertex.occluded != 0u && !hands_on) {
        chosen.weight = 0.0f;
        store_reservoir(pass.reservoirs, index, chosen);
    }
}

/// The sample of this frame.
FN PathSample shade_resampled(uvec2 pixel, IN(ResamplingPass) pass) {
    PathState path = begin_resampled_path(pixel, pass);
    while (path.goes_on || awaits_shadow_ray(path)) {
        if (awaits_shadow_ray(path)) {
            settle_direct_light(
                path, trace_any(path.origin, path.direct.direction, path.direct.t_max, shadow_ray_key(path)));
        } else {
            extend_path(path, trace_closest(path.origin, path.direction, next_ray_key(path)));
        }
    }
    return path.found;
}

#endif
