// ReSTIR direct light (Bitterli et al. 2020) in its unbiased GRIS form (Lin et al. 2022), as passes over the film:
// `first hits` traces the camera's rays.
// `candidates` resamples light points for what the rays met, in passes that pick lights, sample materials where that pays, and trace shadow
// rays if visibility is `target` or `biased-initial`.
// `temporal` merges what the same surface had a frame before; `spatial` merges what neighbours have.
// `shadows` traces the shadow ray to the point that came out.
// `shade` takes the first vertex's direct light from that point and goes on as a path.
// `ris` is all of them but the two that merge.
//
// Passes that trace a ray of every pixel do little else: a device that traverses in its shaders' own registers has more rays in
// flight then.
//
// One frame is one sample of every pixel. The first-vertex hits and the reservoirs lie in memory between passes (hooks.md); a set is
// one whole film of them.
#ifndef RESTIR_KERNEL_H
#define RESTIR_KERNEL_H

#include "restir/candidates.kernel.h"
#include "restir/resampled_path.kernel.h"
#include "restir/reuse_passes.kernel.h"

FN bool has_emitters() { return feature(FEATURE_EMISSIVE) && constants.emissive_triangle_count > 0u; }

/// What sampling the material finds, if anything, with the density of finding it so, all times together: the nearest emitter or, where there
/// is none, the environment, whatever else is before it. `i`: which time.
FN LightPointSample find_light_by_bsdf(IN(FirstSurface) first, IN(CandidatePicker) picker, uint i, INOUT(uint) rays) {
    LightPointSample found;
    found.point = no_light_point();
    found.pdf = 0.0f;
    uvec4 words = independent_words(first.random, DIMENSION_BSDF_CANDIDATE + 2u * i);
    BsdfSample next = surface_bsdf_sample(first.bsdf, first.wo, vec2(unit_float(words.x), unit_float(words.y)),
                                          vec2(unit_float(words.z), unit_float(words.w)), features());
    if (!(next.pdf > 0.0f) || next.delta != 0u) {
        return found;
    }
    BsdfCandidates c = bsdf_candidates(first.bsdf, picker);
    if (has_emitters()) {
        rays += 1u;
        found.point = trace_emitters(first.origin, next.direction, c.reach);
    }
    if (found.point.light == NONE && !(c.reach < INFINITE_DISTANCE)) {
        found.point.light = environment_light();
        found.point.uv = direction_uv(next.direction);
    }
    if (found.point.light < constants.light_count) {
        SeenLight light = see_light_point(found.point, first.origin, MOMENT_CURRENT);
        float times = MUTANT(NARROW_COUNTED_ONCE, c.count, min(c.count, 1.0f));
        found.pdf = is_within(c, first.origin, light) ? times * next.pdf * light.measure : 0.0f;
    }
    return found;
}

/// Takes from a picked point what it shares with sampling the material, unless an emitter is before it.
FN void share_picked(IN(CandidateRequest) request, IN(ResamplingPass) pass) {
    if ((request.needs & CANDIDATE_SHARES) == 0u) {
        return;
    }
    FirstVertex vertex = load_first_vertex(request.pixel);
    Reservoir picked = load_reservoir(pass.reservoirs, request.pixel);
    SeenLight light = see_light_point(picked.point, vertex.origin, MOMENT_CURRENT);
    bool behind = false;
    if (has_emitters()) {
        vec3 way = light.distant ? light.direction : light.end - vertex.origin;
        float t_max = light.distant ? INFINITE_DISTANCE : 0.9999f;
        behind = MUTANT(EMITTERS_HIDE_NONE, trace_emitters(vertex.origin, way, t_max).light != NONE, false);
        vertex.rays += 1u;
        store_first_vertex(request.pixel, vertex);
    }
    picked.weight *= behind ? 1.0f : 1.0f - request.share;
    store_reservoir(pass.reservoirs, request.pixel, picked);
}

/// Adds what sampling the material finds to what there is, once an iteration of the pass.
FN void add_bsdf_candidate(IN(CandidateRequest) request, IN(ResamplingPass) pass) {
    uint least = CANDIDATE_SAMPLES_BSDF | (pass.iteration > 0u ? CANDIDATE_IS_NARROW : 0u);
    if ((request.needs & least) != least) {
        return;
    }
    uint index = request.pixel;
    uvec2 pixel = uvec2(index % constants.size.x, index / constants.size.x);
    FirstVertex vertex = load_first_vertex(index);
    FirstSurface first = load_first_surface(pixel, pass, vertex.hit);
    CandidatePicker picker = resume_candidate_picker(unpack_reuse_surface(first.packed, features()), request);
    LightPointSample found = find_light_by_bsdf(first, picker, pass.iteration, vertex.rays);
    store_first_vertex(index, vertex);
    if (!(found.pdf > 0.0f)) {
        return;
    }
    SeenLight light = see_light_point(found.point, first.origin, MOMENT_CURRENT);
    vec3 f = surface_bsdf_eval(first.bsdf, first.wo, light.direction, features());
    float target = candidate_target(first, light, f);
    float pdf_picked = picks_of_light(picker, found.point.light) * pdf_light_point(found.point);
    uvec4 pick = independent_words(first.random, DIMENSION_BSDF_CANDIDATE + 2u * pass.iteration + 1u);
    Reservoir before = load_reservoir(pass.reservoirs, index);
    Resampling chosen = begin_resampling();
    add_reservoir(chosen, before, before.target, 1.0f, 0.0f);
    add_candidate(chosen, found.point, target, target / (found.pdf + pdf_picked), unit_float(pick.x));
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

/// Whether the point that a reservoir ended with is seen from its first vertex: for the light of this frame, and as the favor with which the
/// point is handed on. Where the target has visibility, it is seen.
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
    float favor = MUTANT(FAVOR_UNASKED, vertex.occluded != 0u ? FAVOR_HIDDEN : 1.0f, 1.0f);
    bool hands_on = MUTANT(FINAL_CULL, constants.resampling.visibility != VISIBILITY_BIASED_FINAL, false);
    bool drops = vertex.occluded != 0u && !hands_on;
    if (favor != chosen.favor || drops) {
        chosen.favor = favor;
        chosen.weight = drops ? 0.0f : chosen.weight;
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
