// ReSTIR for direct light (Bitterli et al. 2020) in its unbiased GRIS form (Lin et al. 2022), as passes over the film:
// `first hits` traces the camera rays.
// `candidates` resamples light points for the first vertices. Its own passes pick lights, sample materials where that
// reduces noise, and trace shadow rays if the visibility setting is `target` or `biased-initial`.
// `temporal` merges reservoirs of the frame before; `spatial` merges reservoirs of neighbours.
// `shadows` traces the shadow ray to the selected point.
// `shade` takes the first vertex's direct light from that point and continues as a path.
// `ris` runs all of them except `temporal` and `spatial`.
//
// Passes that trace one ray per pixel do little else, because a device whose traversal shares registers with the
// shader can then keep more rays in flight.
//
// One frame is one sample of every pixel. First vertices and reservoirs are kept in memory between passes (hooks.md).
// A set is one array over the film.
#ifndef RESTIR_KERNEL_H
#define RESTIR_KERNEL_H

#include "restir/candidates.kernel.h"
#include "restir/resampled_path.kernel.h"
#include "restir/reuse.kernel.h"

FN bool has_emitters() { return feature(FEATURE_EMISSIVE) && constants.emissive_triangle_count > 0u; }

/// The light point that material sample number `i` finds, if any: the nearest emitter, or the environment if no
/// emitter is hit, whatever else occludes them. Its pdf is the expected number of times that all material samples find
/// it.
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

/// Removes material sampling's share from a picked point's weight, unless an emitter is in front of the point.
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

/// Adds the light point found by one material sample to the reservoir. Called once for each iteration of the pass.
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

/// Traces the camera ray.
FN void find_first_vertex(uvec2 pixel, IN(ResamplingPass) pass) {
    PathState path = begin_path(pixel, pass.frame);
    FirstVertex vertex;
    vertex.hit = trace_closest(path.origin, path.direction, next_ray_key(path));
    vertex.origin = vec3(0.0f, 0.0f, 0.0f);
    vertex.rays = 0u;
    vertex.occluded = 0u;
    store_first_vertex(pixel_index(pixel), vertex);
}

/// Drops the initial sample if it is occluded.
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

/// Traces the shadow ray to the selected point. The result serves this frame's direct light and sets the favor with
/// which the point is passed on. Where the target includes visibility, the point is known to be visible.
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

/// The radiance of this frame's sample.
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
