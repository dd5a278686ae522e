// Any light: the only switch over kinds of light (light_kind). The id of a light determines its kind: emissive
// triangles come first, then punctual lights, then the environment. Paths pick a light at a vertex (pick_light) and
// sample it, per solid angle (sample_light). Resampling uses points on lights, per uv (light_point.h).
#ifndef LIGHT_KERNEL_H
#define LIGHT_KERNEL_H

#include "lights/emitter.kernel.h"
#include "lights/environment.kernel.h"
#include "lights/light_tree.kernel.h"
#include "lights/punctual.kernel.h"

FN uint light_kind(uint id) {
    if (feature(FEATURE_EMISSIVE) && id < constants.emissive_triangle_count) {
        return LIGHT_EMITTER;
    }
    return feature(FEATURE_PUNCTUAL) && id - constants.emissive_triangle_count < constants.punctual_light_count
               ? LIGHT_PUNCTUAL
               : LIGHT_ENVIRONMENT;
}

FN bool is_emitter(uint id) { return light_kind(id) == LIGHT_EMITTER; }

/// Index into punctual_lights.
FN uint punctual_index(uint id) { return id - constants.emissive_triangle_count; }

/// The id of the environment. It is a light only if light_count is greater.
FN uint environment_light() { return constants.emissive_triangle_count + constants.punctual_light_count; }

/// Picks a light in proportion to its power, with a defensive share of uniform picking. light_count must be positive.
/// `words` are two random words.
FN uint pick_light_by_power(uvec2 words) {
    uint column = alias_column(words.x, constants.light_count);
    return alias_pick(load_light_table(column), column, words.y);
}

// For paths. `draws` are the vertex's first four pairs (dimensions.h); `facing` is pack_facing of the vertex's normal.

/// Whether lights are picked from the light tree. There is none where there are fewer than two lights to choose from.
FN bool picks_from_tree() {
    return feature(FEATURE_LIGHT_TREE) && constants.light_sampler == LIGHT_SAMPLER_SPATIAL;
}

/// Probability with which pick_light picks the light, whose probability by power is `by_power`, at `reference`.
FN float pick_probability(uint id, float by_power, vec3 reference, uint facing) {
    if (picks_from_tree()) {
        return MUTANT(TREE_HIT_BY_POWER, probability_from_tree(id, reference, facing), by_power);
    }
    if (constants.light_sampler == LIGHT_SAMPLER_UNIFORM) {
        return by_power > 0.0f ? 1.0f / float(constants.light_count) : 0.0f;
    }
    return by_power;
}

/// Probability by power of any light.
FN float power_probability(uint id) {
    uint kind = light_kind(id);
    if (kind == LIGHT_EMITTER) {
        return load_emissive_triangles(id).pmf;
    }
    return kind == LIGHT_PUNCTUAL ? load_punctual_lights(punctual_index(id)).pmf : constants.environment.pmf;
}

/// Picks a light; NONE where there is none, or where its back, which does not emit, faces `reference`.
FN LightPick pick_light(vec3 reference, uint facing, IN(FourPairs) draws) {
    LightPick pick = no_light_pick();
    if (constants.light_count == 0u) {
        return pick;
    }
    uvec2 words = uvec2(draws.first.z, draws.second.z);
    if (picks_from_tree()) {
        pick = pick_from_tree(reference, facing, words);
    } else if (constants.light_sampler == LIGHT_SAMPLER_UNIFORM) {
        pick.id = alias_column(words.x, constants.light_count);
        pick.pmf = pick_probability(pick.id, power_probability(pick.id), reference, facing);
    } else {
        pick.id = pick_light_by_power(words);
        pick.pmf = power_probability(pick.id);
    }
    RECORD(light, pick.id);
    if (is_emitter(pick.id)) {
        LOCAL(EmissiveTriangle) light = load_emissive_triangles(pick.id);
        bool one_sided = MUTANT(ONE_SIDED_AS_TWO_SIDED, (light.flags & EMITTER_TWO_SIDED) == 0u, false);
        pick.id = one_sided && is_behind(light, reference) ? NONE : pick.id;
    }
    return pick;
}

/// Density per solid angle with which light sampling at `reference` finds this point of a surface.
FN float pdf_light_of_hit(IN(Surface) s, vec3 reference, uint facing) {
    uint id = light_of_surface(s);
    if (id == NONE) {
        return 0.0f;
    }
    LOCAL(EmissiveTriangle) light = load_emissive_triangles(id);
    return pdf_emitter(light, pick_probability(id, light.pmf, reference, facing), reference, s.position);
}

/// Density per solid angle with which light sampling at `reference` finds this direction of the environment.
FN float pdf_light_of_miss(vec3 direction, vec3 reference, uint facing) {
    float pmf = constants.environment.pmf;
    if (pmf > 0.0f) {
        pmf = pick_probability(environment_light(), pmf, reference, facing);
    }
    return pdf_environment(pmf, direction);
}

/// The random numbers that choose a point on a light.
FN vec2 light_point_draws(IN(FourPairs) draws) { return vec2(unit_float(draws.first.w), unit_float(draws.second.w)); }

/// Samples the picked light; for an emitter, at the point `on_emitter`. `dimension` is the vertex's first dimension.
FN LightSample sample_light(IN(LightPick) pick, IN(TriangleSample) on_emitter, vec3 reference, IN(FourPairs) draws,
                            IN(Sampler) random, uint dimension) {
    uint kind = light_kind(pick.id);
    if (kind == LIGHT_EMITTER) {
        return sample_emitter(load_emissive_triangles(pick.id), pick.pmf, reference, on_emitter);
    }
    if (kind == LIGHT_PUNCTUAL) {
        LightSample s = see_punctual(load_punctual_lights(punctual_index(pick.id)), reference);
        s.pdf = s.pdf > 0.0f ? pick.pmf : 0.0f;
        return s;
    }
    return sample_environment(pick.pmf, random, dimension, light_point_draws(draws));
}

// For resampling.

/// Samples a point of light `id`: uniformly by area on a triangle, by the map for the environment. `more` are two
/// random words for the map.
FN LightPointSample sample_light_point(uint id, vec2 u, uvec2 more) {
    LightPointSample s;
    s.point = no_light_point();
    s.point.light = id;
    uint kind = light_kind(id);
    if (kind == LIGHT_EMITTER) {
        bool folded = u.x + u.y > 1.0f;
        s.point.uv = folded ? vec2(1.0f - u.x, 1.0f - u.y) : u;
        s.pdf = 2.0f * load_emissive_triangles(id).pmf;
    } else if (kind == LIGHT_PUNCTUAL) {
        s.pdf = load_punctual_lights(punctual_index(id)).pmf;
    } else {
        LightSample light = sample_environment_direction(constants.environment.pmf, more, u);
        s.point.uv = direction_uv(light.direction);
        s.pdf = light.pdf * (2.0f * PI);
    }
    return s;
}

/// The light point as seen from `reference`, among the lights of `moment` (MOMENT_…).
FN SeenLight see_light_point(IN(LightPoint) y, vec3 reference, uint moment) {
    if (y.light >= constants.light_count) {
        return unseen_light();
    }
    uint kind = light_kind(y.light);
    if (kind == LIGHT_EMITTER) {
        return see_emitter(emissive_triangle_at(moment, y.light), y.uv, reference);
    }
    if (kind == LIGHT_PUNCTUAL) {
        return see_punctual_point(punctual_light_at(moment, punctual_index(y.light)), reference);
    }
    return see_environment(y.uv);
}

/// Density per uv with which sample_light_point finds `y`, including the pick of its light by power.
FN float pdf_light_point(IN(LightPoint) y) {
    uint kind = light_kind(y.light);
    if (kind == LIGHT_EMITTER) {
        return 2.0f * load_emissive_triangles(y.light).pmf;
    }
    if (kind == LIGHT_PUNCTUAL) {
        return load_punctual_lights(punctual_index(y.light)).pmf;
    }
    return pdf_environment(constants.environment.pmf, uv_direction(y.uv)) * (2.0f * PI);
}

/// The part of a cluster that contains the light (light_clusters.h); NONE where it is in none.
FN uint cluster_part_of_light(uint id) {
    uint kind = light_kind(id);
    if (kind == LIGHT_EMITTER) {
        return part_of_flags(load_emissive_triangles(id).flags);
    }
    return kind == LIGHT_PUNCTUAL ? load_punctual_lights(punctual_index(id)).part : NONE;
}

#endif
