// The path integrator (Kajiya 1986; Veach 1997). Its three forms share one integrand and differ in how they find
// light: `brdf` by sampling the material, `direct` by sampling lights, `path` by both, weighted by MIS. Light that
// only one strategy can find (punctual lights; lights seen directly or in a mirror) counts fully in all three.
#ifndef PATH_KERNEL_H
#define PATH_KERNEL_H

#include "geometry/alpha.kernel.h"
#include "lights/light.kernel.h"

/// Index of a pixel in every array that has one element per pixel.
FN uint pixel_index(uvec2 pixel) { return pixel.y * constants.size.x + pixel.x; }

/// One sample of one pixel.
struct PathSample {
    vec3 radiance;
    uint rays;
    FirstHit first_hit;
};

/// The first hit of a sample that hits nothing.
FN FirstHit no_first_hit() {
    FirstHit hit;
    hit.albedo = vec3(0.0f, 0.0f, 0.0f);
    hit.normal = vec3(0.0f, 0.0f, 0.0f);
    hit.depth = 0.0f;
    return hit;
}

/// Probability that Russian roulette lets a path continue: 1 up to its third vertex (depth 0 to 2), at most 0.95 from
/// then on.
FN float survival_probability(vec3 throughput, uint depth) {
    return depth < 3u ? 1.0f : min(MUTANT(ROULETTE_BY_RED, max_component(throughput), throughput.x), 0.95f);
}

/// The key of one ray for the hash that decides stochastic alpha. It is never NONE.
FN uint ray_alpha_key(IN(Sampler) random, uint ray) {
    if (!feature(FEATURE_ALPHA)) {
        return 0u;
    }
    return pcg4d(uvec4(random.key.x, random.key.y, random.sample_index, 0x416c7068u ^ ray)).x >> 1;
}

/// MIS weight of light found by sampling the material with density `pdf`, where light sampling has density
/// `pdf_light`.
FN float bsdf_sampling_weight(float pdf, float pdf_light) {
    if (weighs_by_mis(constants.integrator)) {
        return MUTANT(MIS_ONE_AT_HIT, mis_weight(constants.mis, pdf, pdf_light), 1.0f);
    }
    return samples_material(constants.integrator) ? 1.0f : 0.0f;
}

FN float light_sampling_weight(IN(LightSample) light, float pdf) {
    if (light.delta || !weighs_by_mis(constants.integrator)) {
        return 1.0f;
    }
    return MUTANT(MIS_ONE_AT_LIGHT, mis_weight(constants.mis, light.pdf, pdf), 1.0f);
}

/// Whether the MIS weight of light found by sampling the material needs the light's pdf.
FN bool needs_light_pdf() { return feature(FEATURE_LIGHT_SAMPLING) && weighs_by_mis(constants.integrator); }

/// Whether light is exactly black. NaN is not black: it has to reach the film, which counts it.
FN bool is_black(vec3 radiance) { return radiance.x == 0.0f && radiance.y == 0.0f && radiance.z == 0.0f; }

/// The contribution of one sampled light, not yet tested for visibility. `radiance` is added if the shadow ray is
/// unoccluded; if it is black, no shadow ray is needed. The shadow ray and the path's next ray have the same origin.
struct DirectLight {
    vec3 radiance;
    vec3 direction;  // of the shadow ray
    float t_max;
};

FN DirectLight no_direct_light() {
    DirectLight direct;
    direct.radiance = vec3(0.0f, 0.0f, 0.0f);
    direct.direction = vec3(0.0f, 0.0f, 1.0f);
    direct.t_max = 0.0f;
    return direct;
}

/// A path vertex on a surface that scatters.
struct Vertex {
    vec3 position;
    vec3 origin;  // of rays that leave the surface
    SurfaceBsdf bsdf;
    SeenBsdf seen;
    uint dimension;  // the vertex's first dimension
    FourPairs draws;
    uint facing;                // pack_facing of the normal, for picking lights
    bool samples_light;
    LightPick light;            // its id is NONE where no light is sampled
    TriangleSample on_emitter;  // a point of the picked light, if that is an emitter
};

/// Samples the light that was picked at the vertex.
FN DirectLight sample_direct_light(IN(Vertex) v, IN(Sampler) random) {
    DirectLight direct = no_direct_light();
    LightSample light = sample_light(v.light, v.on_emitter, v.position, v.draws, random, v.dimension);
    RECORD(light_pdf, light.pdf);
    if (!(light.pdf > 0.0f) || is_black(light.radiance)) {
        return direct;
    }
    BsdfValue f = surface_bsdf_eval_pdf(v.bsdf, v.seen, light.direction, features());
    direct.radiance = f.value * light.radiance * (light_sampling_weight(light, f.pdf) / light.pdf);
    direct.direction = light.distant ? light.direction : light.end - v.origin;
    direct.t_max = light.distant ? INFINITE_DISTANCE : MUTANT(SHORT_SHADOW_RAY, 0.9999f, 0.9999f * 0.99f);
    return direct;
}

/// Direct light from the light point that resampling selected, with its contribution weight W.
FN DirectLight resampled_direct_light(IN(Vertex) v, IN(Reservoir) chosen) {
    DirectLight direct = no_direct_light();
    if (!(chosen.weight > 0.0f)) {
        return direct;
    }
    SeenLight light = see_light_point(chosen.point, v.position, MOMENT_CURRENT);
    BsdfValue f = surface_bsdf_eval_pdf(v.bsdf, v.seen, light.direction, features());
    direct.radiance = f.value * light.radiance * (light.measure * chosen.weight);
    direct.direction = light.distant ? light.direction : light.end - v.origin;
    direct.t_max = light.distant ? INFINITE_DISTANCE : 0.9999f;
    return direct;
}

/// Whether the first vertex takes all of its direct light from a reservoir.
FN bool resamples_first_vertex() { return feature(FEATURE_RESAMPLING) && resamples_lights(constants.integrator); }

/// A path in progress: its next ray, and what it has accumulated.
struct PathState {
    Sampler random;
    PathSample found;
    vec3 origin;
    vec3 direction;
    vec3 throughput;
    vec3 reference;        // the last vertex, from which lights were sampled
    uint facing;           // pack_facing of the normal there
    float pdf_direction;   // of `direction`, per solid angle
    bool only_strategy;    // light sampling cannot find what the next ray may find
    bool goes_on;
    uint depth;            // number of scattering events so far
    DirectLight direct;    // sampled at the last vertex, not yet tested for visibility
    Reservoir reservoir;   // of the first vertex, for integrators that resample lights
    bool light_is_complete;  // all direct light of the last vertex is counted, unless only_strategy
};

FN PathState begin_path(uvec2 pixel, uint sample_index) {
    PathState path;
    path.random = make_sampler(pixel, sample_index, constants.seed, constants.sampler_kind, constants.sample_count);
    path.found.radiance = vec3(0.0f, 0.0f, 0.0f);
    path.found.rays = 0u;
    path.found.first_hit = no_first_hit();

    vec2 jitter = sample_2d(path.random, DIMENSION_FILM);
    uvec2 place = pixel;
    uvec2 size = constants.size;
    if (feature(FEATURE_RESAMPLING) && constants.atlas_tile != 0u) {
        size = uvec2(constants.atlas_tile, constants.atlas_tile);
        place = uvec2(pixel.x % size.x, pixel.y % size.y);
    }
    vec2 film = vec2((float(place.x) + jitter.x) / float(size.x), (float(place.y) + jitter.y) / float(size.y));
    vec2 lens = vec2(0.5f, 0.5f);
    if (feature(FEATURE_THIN_LENS)) {
        lens = sample_2d(path.random, DIMENSION_LENS);
    }
    camera_ray(constants.camera, film, lens, feature(FEATURE_THIN_LENS), feature(FEATURE_ORTHOGRAPHIC), path.origin,
               path.direction);
    path.throughput = vec3(1.0f, 1.0f, 1.0f);
    path.reference = path.origin;
    path.facing = 0u;
    path.pdf_direction = 0.0f;
    path.only_strategy = true;
    path.goes_on = true;
    path.depth = 0u;
    path.direct = no_direct_light();
    path.reservoir = empty_reservoir();
    path.light_is_complete = false;
    return path;
}

/// Adds radiance from infinity, for a ray that left the scene.
FN void add_environment(INOUT(PathState) path) {
    if (path.light_is_complete && !path.only_strategy) {
        return;
    }
    vec3 radiance = environment_radiance(path.direction);
    RECORD(emission_weight, 1.0f);
    if (!path.only_strategy) {
        float pdf_light = 0.0f;
        if (needs_light_pdf()) {
            pdf_light = pdf_light_of_miss(path.direction, path.reference, path.facing);
        }
        float weight = bsdf_sampling_weight(path.pdf_direction, pdf_light);
        radiance = radiance * weight;
        RECORD(emission_weight, weight);
    }
    path.found.radiance += path.throughput * radiance;
    RECORD(emission, path.throughput * radiance);
}

/// Adds radiance that the surface emits toward the path.
FN void add_emission(INOUT(PathState) path, IN(Surface) surface, IN(Material) material) {
    bool emits = feature(FEATURE_EMISSIVE) && (material.flags & MATERIAL_EMISSIVE) != 0u &&
                 (path.only_strategy || !path.light_is_complete);
    if (emits && (dot(surface.normal, path.direction) < 0.0f || (material.flags & MATERIAL_DOUBLE_SIDED) != 0u)) {
        float weight = 1.0f;
        if (!path.only_strategy) {
            float pdf_light = 0.0f;
            if (needs_light_pdf()) {
                pdf_light = pdf_light_of_hit(surface, path.reference, path.facing);
            }
            weight = bsdf_sampling_weight(path.pdf_direction, pdf_light);
        }
        weight = MUTANT(EMISSION_TWICE, weight, path.depth == 1u ? 2.0f * weight : weight);
        vec3 emission = path.throughput * (weight * material_emission(material, surface.mesh));
        path.found.radiance += emission;
        RECORD(emission, emission);
        RECORD(emission_weight, weight);
    }
}

FN uint next_ray_key(IN(PathState) path) { return ray_alpha_key(path.random, 2u * path.depth); }

FN uint shadow_ray_key(IN(PathState) path) { return ray_alpha_key(path.random, 2u * path.depth - 1u); }

/// Processes the hit of the path's ray: adds emitted light, and makes the new vertex. Returns whether the path scatters
/// there. The caller then picks a light, samples a point on it, if it is an emitter, and calls leave_vertex.
FN bool arrive_at_vertex(INOUT(PathState) path, IN(Hit) hit, INOUT(Vertex) v) {
    uint depth = path.depth;
    path.found.rays += 1u;
    path.goes_on = false;
    if (hit.instance == NONE) {
        add_environment(path);
        return false;
    }
    vec3 wo = -path.direction;
    LOCAL(Instance) instance = load_instances(hit.instance);
    Surface surface = load_surface(hit, instance, path.origin, path.direction);
    LOCAL(Material) material = load_materials(surface.mesh.geometry.material);
    RECORD(position, surface.position);
    RECORD(barycentrics, surface.mesh.barycentrics);
    add_emission(path, surface, material);

    bool last = MUTANT(DEPTH_OFF_BY_ONE, depth == constants.max_depth, depth > constants.max_depth) ||
                (material.flags & MATERIAL_UNLIT) != 0u;
    bool wants_layers = feature(FEATURE_FIRST_HIT_LAYERS) && depth == 0u;
    if (last && !wants_layers) {
        return false;
    }
    v.bsdf = load_bsdf(surface, instance, material, wo);
    v.seen = see_bsdf(v.bsdf, wo, features());
    RECORD(normal, v.bsdf.mapped_normal);
    if (wants_layers) {
        path.found.first_hit.albedo = xyz(base_color(material, surface.mesh));
        path.found.first_hit.normal =
            v.seen.mapped == NORMAL_MAP_MICROFACET ? v.bsdf.mapped_normal : v.seen.diffuse_normal;
        path.found.first_hit.depth = hit.t;
    }
    if (last) {
        return false;
    }
    v.position = surface.position;
    // Rays leave on wo's side: nothing is scattered through the surface.
    v.origin = offset_ray(surface.start, v.bsdf.geometric_normal, surface.magnitude);
    v.dimension = DIMENSION_VERTEX + depth * DIMENSIONS_PER_VERTEX;
    v.draws = sample_bits_four_pairs(path.random, v.dimension);
    v.light = no_light_pick();
    v.facing = feature(FEATURE_LIGHT_TREE) ? pack_facing(v.seen.diffuse_normal) : 0u;
    path.light_is_complete = depth == 0u && resamples_first_vertex();
    v.samples_light = !path.light_is_complete && feature(FEATURE_LIGHT_SAMPLING) &&
                      !bsdf_is_purely_delta(v.bsdf.parameters, features());
    return true;
}

/// Picks a light for the vertex, if it samples one. The caller then samples a point on it, if that is an emitter.
FN void pick_vertex_light(INOUT(Vertex) v) {
    if (v.samples_light) {
        v.light = pick_light(v.position, v.facing, v.draws);
    }
}

/// Samples the picked light, or takes the reservoir's light point, and samples the next direction. The caller tests
/// the light's visibility, so that a GPU keeps no surface in registers while it traces.
FN void leave_vertex(INOUT(PathState) path, IN(Vertex) v) {
    uint depth = path.depth;
    if (path.light_is_complete || v.light.id != NONE) {
        if (path.light_is_complete) {
            path.direct = resampled_direct_light(v, path.reservoir);
        } else {
            path.direct = sample_direct_light(v, path.random);
        }
        path.direct.radiance = path.throughput * path.direct.radiance;
        RECORD(direct, path.direct.radiance);
    }

    path.origin = v.origin;
    path.reference = v.position;
    path.facing = v.facing;
    path.depth = depth + 1u;
    if (!feature(FEATURE_LATER_VERTICES)) {
        return;
    }
    vec2 u_direction = vec2(unit_float(v.draws.first.x), unit_float(v.draws.second.x));
    vec2 u_lobe = vec2(unit_float(v.draws.first.y), unit_float(v.draws.second.y));
    BsdfSample next = surface_bsdf_sample(v.bsdf, v.seen, u_lobe, u_direction, features());
    path.throughput = path.throughput * next.weight;
    path.only_strategy = next.delta != 0u;
    bool goes_on = next.pdf > 0.0f && max_component(path.throughput) > 0.0f;
    bool only_lights_left = !path.only_strategy && depth + 1u == constants.max_depth;
    if (only_lights_left && (!samples_material(constants.integrator) || path.light_is_complete)) {
        goes_on = false;  // the last ray could only find light that is already sampled
    }
    float survival = survival_probability(path.throughput, depth);
    if (goes_on && survival < 1.0f) {
        float u = sample_1d(path.random, v.dimension + DIMENSION_ROULETTE);
        goes_on = u < survival;
        path.throughput = path.throughput * MUTANT(ROULETTE_NOT_DIVIDED, 1.0f / survival, 1.0f);
        RECORD(survival, survival);
        RECORD(roulette, goes_on ? ROULETTE_SURVIVED : ROULETTE_KILLED);
    }
    RECORD(lobe, next.lobe);
    RECORD(bsdf_pdf, next.pdf);
    RECORD(throughput, path.throughput);
    path.pdf_direction = next.pdf;
    path.direction = next.direction;
    path.goes_on = goes_on;
}

/// arrive_at_vertex and leave_vertex for one path.
FN void extend_path(INOUT(PathState) path, IN(Hit) hit) {
    Vertex v;
    if (!arrive_at_vertex(path, hit, v)) {
        return;
    }
    pick_vertex_light(v);
    if (is_emitter(v.light.id)) {
        LOCAL(EmissiveTriangle) light = load_emissive_triangles(v.light.id);
        v.on_emitter = sample_emitter_point(light, v.position, light_point_draws(v.draws));
    }
    leave_vertex(path, v);
}

FN bool awaits_shadow_ray(IN(PathState) path) { return !is_black(path.direct.radiance); }

/// Adds the sampled light unless the shadow ray was occluded.
FN void settle_direct_light(INOUT(PathState) path, bool occluded) {
    path.found.rays += 1u;
    if (!occluded) {
        path.found.radiance += path.direct.radiance;
    }
    path.direct.radiance = vec3(0.0f, 0.0f, 0.0f);
}

/// Adds one sample to its pixel's film.
FN void add_path(IN(PathSample) s, INOUT(FilmPixel) film, INOUT(FilmMoments) moments, INOUT(FilmFirstHit) first_hit) {
    bool kept = film_add(film, s.radiance, s.rays);
    if (feature(FEATURE_STANDARD_ERROR) && kept) {
        film_add_moments(moments, s.radiance);
    }
    if (feature(FEATURE_FIRST_HIT_LAYERS)) {
        film_add_first_hit(first_hit, s.first_hit);
    }
}

#endif
