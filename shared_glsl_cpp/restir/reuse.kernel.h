// ReSTIR's passes that merge (restir.kernel.h): which reservoirs a pixel reuses.
#ifndef REUSE_KERNEL_H
#define REUSE_KERNEL_H

#include "restir/merge_reservoirs.kernel.h"

/// The position of the first vertex at the previous moment.
FN vec3 previous_position(vec3 position, IN(Hit) hit) {
    if (!feature(FEATURE_MOTION)) {
        return position;
    }
    LOCAL(Instance) instance = load_previous_instances(hit.instance);
    Geometry g = load_geometries(instance.first_geometry + hit.geometry);
    uvec3 triangle = load_triangles(g.first_triangle + hit.primitive);
    vec3 a = load_positions(g.first_vertex + triangle.x);
    vec3 b = load_positions(g.first_vertex + triangle.y);
    vec3 c = load_positions(g.first_vertex + triangle.z);
    return transform_point(instance, a + hit.barycentrics.x * (b - a) + hit.barycentrics.y * (c - a));
}

/// The rectangle of pixels whose reservoirs a pixel may reuse: its copy of the view, or the whole film.
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

FN void count_rays(uint index, uint rays) {
    if (rays > 0u) {
        FirstVertex vertex = load_first_vertex(index);
        vertex.rays += rays;
        store_first_vertex(index, vertex);
    }
}

/// Merges the reservoir of the same surface point in the frame before.
FN void reuse_temporal(uvec2 pixel, IN(ResamplingPass) pass) {
    uint index = pixel_index(pixel);
    ReuseSurface kept = load_reuse_surface(pass.surfaces, index);
    if (!is_valid(kept) || pass.has_history == 0u) {
        return;
    }
    vec3 before = previous_position(kept.position, load_first_vertex(index).hit);
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
    uint rays = 0u;
    Reservoir merged = merge_reservoirs(unpack_reuse_surface(kept, features()), load_reservoir(pass.reservoirs, index), others, random,
                                        DIMENSION_TEMPORAL, rays);
    store_reservoir(pass.reservoirs, index, merged);
    count_rays(index, rays);
}

/// Merges reservoirs of neighbours.
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
    uint rays = 0u;
    Reservoir merged = merge_reservoirs(unpack_reuse_surface(kept, features()), own, others, random,
                                        DIMENSION_NEIGHBOR_PICK + dimension, rays);
    store_reservoir(pass.other_reservoirs, index, merged);
    count_rays(index, rays);
}

#endif
