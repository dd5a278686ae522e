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
#include "reuse.kernel.h"

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
FN void add_bsdf_candidate(uvec2 pixel, uint needs, IN(ResamplingPass) pass) {
    uint index = pixel_index(pixel);
    FirstVertex vertex = load_first_vertex(index);
    FirstSurface first = load_first_surface(pixel, pass, vertex.hit);
    TargetSurface surface = unpack_reuse_surface(first.packed);
    LightPicker picker = begin_light_picker(surface);
    Reservoir picked = load_reservoir(pass.reservoirs, index);
    Resampling chosen = begin_resampling();
    if (picked.weight > 0.0f) {
        SeenLight light = see_light_point(picked.point, first.origin, MOMENT_CURRENT);
        float kept = 1.0f;
        if ((needs & CANDIDATE_TESTS_PICKED) != 0u) {
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
    if ((needs & CANDIDATE_SAMPLES_BSDF) != 0u) {
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

/// The first vertex's place a frame before.
FN vec3 previous_position(vec3 position, IN(FirstVertex) vertex) {
    if (!feature(FEATURE_MOTION)) {
        return position;
    }
    LOCAL(Instance) instance = load_previous_instances(vertex.hit.instance);
    Geometry g = load_geometries(instance.first_geometry + vertex.hit.geometry);
    uvec3 triangle = load_triangles(g.first_triangle + vertex.hit.primitive);
    vec3 a = load_positions(g.first_vertex + triangle.x);
    vec3 b = load_positions(g.first_vertex + triangle.y);
    vec3 c = load_positions(g.first_vertex + triangle.z);
    return transform_point(instance, a + vertex.hit.barycentrics.x * (b - a) + vertex.hit.barycentrics.y * (c - a));
}

/// The square of pixels among which a pixel may reuse: its copy of the view, or the film.
FN void reuse_bounds(uvec2 pixel, OUT(uvec2) first, OUT(uvec2) size) {
    first = uvec2(0u, 0u);
    size = constants.size;
    if (constants.atlas_tile != 0u) {
        first = uvec2(pixel.x - pixel.x % constants.atlas_tile, pixel.y - pixel.y % constants.atlas_tile);
        size = uvec2(constants.atlas_tile, constants.atlas_tile);
    }
}

FN bool is_inside(vec2 place, uvec2 size) {
    return place.x >= 0.0f && place.y >= 0.0f && place.x < float(size.x) && place.y < float(size.y);
}

FN void reuse_temporal(uvec2 pixel, IN(ResamplingPass) pass) {
    uint index = pixel_index(pixel);
    ReuseSurface kept = load_reuse_surface(pass.surfaces, index);
    if (!is_valid(kept) || pass.has_history == 0u) {
        return;
    }
    FirstVertex vertex = load_first_vertex(index);
    vec3 before = previous_position(kept.position, vertex);
    uvec2 first;
    uvec2 size;
    reuse_bounds(pixel, first, size);
    vec2 film;
    bool ahead = camera_project(constants.previous_camera, before, film);
    vec2 place = floor(vec2(film.x * float(size.x), film.y * float(size.y)));
    if (!ahead || !is_inside(place, size)) {
        return;
    }
    Neighborhood others;
    others.count = 1u;
    others.pixels[0] = pixel_index(uvec2(first.x + uint(place.x), first.y + uint(place.y)));
    others.reservoir_set = pass.other_reservoirs;
    others.surface_set = 1u - pass.surfaces;
    others.moment = MUTANT(REUSE_CURRENT_LIGHTS, MOMENT_PREVIOUS, MOMENT_CURRENT);
    others.confidence_cap = constants.resampling.confidence_cap;
    ReuseSurface expected = kept;
    expected.position = before;
    ReuseSurface there = load_reuse_surface(others.surface_set, others.pixels[0]);
    if (!is_similar(expected, there, constants.previous_camera.origin)) {
        return;
    }
    Sampler random = make_sampler(pixel, pass.frame, constants.seed, constants.sampler_kind, constants.sample_count);
    Reservoir merged = merge_reservoirs(unpack_reuse_surface(kept), load_reservoir(pass.reservoirs, index), others, random,
                                        DIMENSION_TEMPORAL, vertex.rays);
    store_reservoir(pass.reservoirs, index, merged);
    if (target_has_visibility()) {
        store_first_vertex(index, vertex);
    }
}

FN void reuse_spatial(uvec2 pixel, IN(ResamplingPass) pass) {
    uint index = pixel_index(pixel);
    ReuseSurface kept = load_reuse_surface(pass.surfaces, index);
    Reservoir own = load_reservoir(pass.reservoirs, index);
    if (!is_valid(kept)) {
        store_reservoir(pass.other_reservoirs, index, own);
        return;
    }
    uvec2 first;
    uvec2 size;
    reuse_bounds(pixel, first, size);
    vec2 center = vec2(float(pixel.x - first.x) + 0.5f, float(pixel.y - first.y) + 0.5f);
    Sampler random = make_sampler(pixel, pass.frame, constants.seed, constants.sampler_kind, constants.sample_count);
    uint dimension = MUTANT(PASSES_SHARE_SEED, pass.iteration, 0u) * (RESAMPLING_MAX_NEIGHBORS + 1u);
    Neighborhood others;
    others.count = 0u;
    others.reservoir_set = pass.reservoirs;
    others.surface_set = pass.surfaces;
    others.moment = MOMENT_CURRENT;
    others.confidence_cap = INFINITE_DISTANCE;
    for (uint i = 0u; i < constants.resampling.neighbors; i++) {
        uvec4 words = independent_words(random, DIMENSION_NEIGHBOR + dimension + i);
        vec2 offset = sample_disk_concentric(vec2(unit_float(words.x), unit_float(words.y)));
        vec2 place = floor(vec2(center.x + constants.resampling.radius * offset.x,
                                center.y + constants.resampling.radius * offset.y));
        if (!is_inside(place, size)) {
            continue;
        }
        uint other = pixel_index(uvec2(first.x + uint(place.x), first.y + uint(place.y)));
        if (other != index && is_similar(kept, load_reuse_surface(pass.surfaces, other), constants.camera.origin)) {
            others.pixels[others.count] = other;
            others.count += 1u;
        }
    }
    FirstVertex vertex = load_first_vertex(index);
    Reservoir merged = merge_reservoirs(unpack_reuse_surface(kept), own, others, random,
                                        DIMENSION_NEIGHBOR_PICK + dimension, vertex.rays);
    store_reservoir(pass.other_reservoirs, index, merged);
    if (target_has_visibility()) {
        store_first_vertex(index, vertex);
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
