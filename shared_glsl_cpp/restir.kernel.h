// ReSTIR direct light (Bitterli et al. 2020) in its unbiased GRIS form (Lin et al. 2022), as passes over the film: `first hits` traces
// the camera's rays; `candidates` resamples light points for what they met; `temporal` merges what the same surface had a frame before;
// `spatial` merges what neighbours have; `shadows` asks whether the point that came out is seen; `shade` takes the first vertex's direct
// light from it and goes on as a path. `ris` is all of them but the two that merge.
//
// Passes that trace a ray of every pixel do little else: a device that traverses in its shaders' own registers has more rays in
// flight then.
//
// One frame is one sample of every pixel. The first-vertex hits and the reservoirs lie in memory between passes (hooks.md); a set is
// one whole film of them.
#ifndef RESTIR_KERNEL_H
#define RESTIR_KERNEL_H

#include "resampled_path.kernel.h"
#include "reuse.kernel.h"

/// Whether a surface's lobe is narrow enough that sampling it finds light points which picking lights seldom does.
FN bool wants_bsdf_candidate(IN(SurfaceBsdf) bsdf) {
    return constants.resampling.bsdf_candidates != 0u && bsdf.parameters.alpha < 0.1f &&
           max(max_component(bsdf.parameters.f0), max_component(bsdf.parameters.f90)) > 0.0f;
}

/// Whether neighbours may reuse what a surface found. Where the target had to widen the lobe, the integrand exceeds it by the square of
/// the ratio: a point that others chose by the wide lobe would be a firefly now and then, where sampling the material finds none.
FN bool wants_reuse(IN(SurfaceBsdf) bsdf) { return bsdf.parameters.alpha >= TARGET_ALPHA_MIN; }

/// Light points picked by power, one kept in proportion to the target.
FN Resampling resample_lights(IN(TargetSurface) surface, IN(Sampler) random) {
    Resampling chosen = begin_resampling();
    uint count = constants.resampling.light_candidates;
    for (uint i = 0u; i < count; i++) {
        uvec4 words = independent_words(random, DIMENSION_CANDIDATE + i);
        uvec4 pick = independent_words(random, DIMENSION_CANDIDATE_PICK + i);
        LightPointSample candidate = sample_light_point(words, uvec2(pick.y, pick.z));
        if (!(candidate.pdf > 0.0f)) {
            continue;
        }
        float target = unoccluded_target(surface, see_light_point(candidate.point, surface.position, MOMENT_CURRENT));
        add_candidate(chosen, candidate.point, target, target / (float(count) * candidate.pdf), unit_float(pick.x));
    }
    return chosen;
}

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

/// Adds what sampling the material finds to what picking lights found. The material's sampling finds only what is visible, so the
/// balance heuristic between the two has to know whether the picked point is; without that every point in shadow would lose a part of
/// its weight, and neighbours that see it would be too dark.
FN Resampling add_bsdf_candidate(IN(Resampling) lights, IN(TargetSurface) surface, IN(SurfaceBsdf) bsdf, IN(SeenBsdf) seen,
                                 vec3 origin, IN(Sampler) random, INOUT(uint) rays) {
    Resampling chosen = begin_resampling();
    float count = float(constants.resampling.light_candidates);
    if (lights.target > 0.0f) {
        SeenLight light = see_light_point(lights.point, surface.position, MOMENT_CURRENT);
        float pdf_bsdf = 0.0f;
        if (light.by_chance) {
            BsdfValue f = surface_bsdf_eval_pdf(bsdf, seen, light.direction, features());
            pdf_bsdf = f.pdf * light.measure;
        }
        if (pdf_bsdf > 0.0f) {
            rays += 1u;
            bool unseen = MUTANT(BSDF_CANDIDATE_BLIND, is_light_occluded(surface, light, lights.point, MOMENT_CURRENT), false);
            pdf_bsdf = unseen ? 0.0f : pdf_bsdf;
        }
        float pdf_lights = count * pdf_light_point(lights.point);
        float share = pdf_lights / (pdf_lights + pdf_bsdf);
        add_candidate(chosen, lights.point, lights.target, share * lights.weight_sum, 0.0f);
    }
    uvec4 words = independent_words(random, DIMENSION_BSDF_CANDIDATE);
    uvec4 pick = independent_words(random, DIMENSION_BSDF_CANDIDATE + 1u);
    BsdfSample next = surface_bsdf_sample(bsdf, seen, vec2(unit_float(words.x), unit_float(words.y)),
                                          vec2(unit_float(words.z), unit_float(words.w)), features());
    if (next.pdf > 0.0f && next.delta == 0u) {
        rays += 1u;
        Hit hit = trace_closest(origin, next.direction, ray_alpha_key(random, 0x40000000u));
        LightPoint y = light_point_of_hit(hit, next.direction);
        if (y.light < constants.light_count) {
            SeenLight light = see_light_point(y, surface.position, MOMENT_CURRENT);
            float target = light.by_chance ? unoccluded_target(surface, light) : 0.0f;
            float pdf_bsdf = next.pdf * light.measure;
            float total = pdf_bsdf + count * pdf_light_point(y);
            add_candidate(chosen, y, target, target / total, unit_float(pick.x));
        }
    }
    return chosen;
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

/// The first vertex's initial reservoir, of confidence 1 whatever it holds.
FN void resample_candidates(uvec2 pixel, IN(ResamplingPass) pass) {
    uint index = pixel_index(pixel);
    PathState path = begin_path(pixel, pass.frame);
    FirstVertex vertex = load_first_vertex(index);
    Reservoir reservoir = empty_reservoir();
    ReuseSurface kept = no_reuse_surface();
    if (vertex.hit.instance != NONE && constants.max_depth > 0u) {
        vec3 wo = -path.direction;
        LOCAL(Instance) instance = load_instances(vertex.hit.instance);
        Surface surface = load_surface(vertex.hit, instance, path.origin, path.direction);
        LOCAL(Material) material = load_materials(surface.mesh.geometry.material);
        SurfaceBsdf bsdf = load_bsdf(surface, instance, material, wo);
        if ((material.flags & MATERIAL_UNLIT) == 0u && !bsdf_is_purely_delta(bsdf.parameters, features())) {
            vertex.origin = offset_ray(surface.start, bsdf.geometric_normal, surface.magnitude);
            ReuseSurface described = pack_reuse_surface(vertex.origin, bsdf, wo);
            TargetSurface target = unpack_reuse_surface(described);
            if (wants_reuse(bsdf)) {
                kept = described;
            }
            Resampling chosen = resample_lights(target, path.random);
            if (wants_bsdf_candidate(bsdf)) {
                SeenBsdf seen = see_bsdf(bsdf, wo, features());
                chosen = add_bsdf_candidate(chosen, target, bsdf, seen, vertex.origin, path.random, vertex.rays);
            }
            reservoir = end_resampling(chosen, 1.0f, MUTANT(CONFIDENCE_BY_SAMPLE, 1.0f, clamp(chosen.target, 0.1f, 10.0f)));
            bool tests_visibility = MUTANT(INITIAL_CULL, false, true) || constants.resampling.visibility == VISIBILITY_IN_TARGET ||
                                    constants.resampling.visibility == VISIBILITY_BIASED_INITIAL;
            if (tests_visibility && reservoir.weight > 0.0f) {
                SeenLight light = see_light_point(reservoir.point, target.position, MOMENT_CURRENT);
                vertex.rays += 1u;
                if (is_light_occluded(target, light, reservoir.point, MOMENT_CURRENT)) {
                    reservoir = empty_reservoir();
                    reservoir.confidence = MUTANT(CULL_TAKES_CONFIDENCE, 1.0f, 0.0f);
                }
            }
        }
    }
    store_first_vertex(index, vertex);
    store_reservoir(pass.reservoirs, index, reservoir);
    if (constants.integrator == INTEGRATOR_RESTIR) {
        store_reuse_surface(pass.surfaces, index, kept);
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
    vec3 direction = light.distant ? light.direction : light.end - vertex.origin;
    float t_max = light.distant ? INFINITE_DISTANCE : 0.9999f;
    Sampler random = make_sampler(pixel, pass.frame, constants.seed, constants.sampler_kind, constants.sample_count);
    vertex.occluded = trace_any(vertex.origin, direction, t_max, ray_alpha_key(random, 1u)) ? 1u : 0u;
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
