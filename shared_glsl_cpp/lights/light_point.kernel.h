// Points on lights, named so that they can be kept and looked at again: from other surfaces, and at the moment before.
#ifndef LIGHT_POINT_KERNEL_H
#define LIGHT_POINT_KERNEL_H

#include "lights/light.kernel.h"

/// A light point as a reference point sees it, unoccluded. f · radiance · measure is the integrand per unit of uv measure.
struct SeenLight {
    vec3 direction;  // unit
    vec3 radiance;   // arriving; of a punctual light: already divided by r²
    float measure;   // solid angle per uv; 1 for punctual lights; 0: the point cannot be seen from there
    bool by_chance;  // a ray that material sampling sends there always finds it: no punctual light, no emitter with alpha
    bool distant;
    vec3 end;        // where the shadow ray ends, offset from the light's surface
};

FN SeenLight unseen_light() {
    SeenLight s;
    s.direction = vec3(0.0f, 0.0f, 1.0f);
    s.radiance = vec3(0.0f, 0.0f, 0.0f);
    s.measure = 0.0f;
    s.by_chance = false;
    s.distant = false;
    s.end = vec3(0.0f, 0.0f, 0.0f);
    return s;
}

/// Directions as uv: x is 1 - |z| with z's sign, y the turn about z in [0, 1). Keeps its digits at both poles; 2 pi sr per uv.
FN vec2 direction_uv(vec3 d) {
    float sine2 = d.x * d.x + d.y * d.y;
    float height = sine2 / (1.0f + abs(d.z));
    float turn = arctan2(d.y, d.x) * (0.5f * INV_PI);
    return vec2(d.z < 0.0f ? -max(height, 1.0e-30f) : height, turn < 0.0f ? turn + 1.0f : turn);
}

FN vec3 uv_direction(vec2 uv) {
    float height = abs(uv.x);
    float z = 1.0f - height;
    float sine = safe_sqrt(height * (1.0f + z));
    float s;
    float c;
    sin_cos(2.0f * PI * uv.y, s, c);
    return vec3(sine * c, sine * s, uv.x < 0.0f ? -z : z);
}

/// The lights as they are, or as they were at the moment that reuse looks back to.
FN EmissiveTriangle emissive_triangle_at(uint moment, uint id) {
    if (feature(FEATURE_MOTION) && moment == MUTANT(PREVIOUS_EMITTERS_CURRENT, MOMENT_PREVIOUS, NONE)) {
        return load_previous_emissive_triangles(id);
    }
    return load_emissive_triangles(id);
}

FN PunctualLight punctual_light_at(uint moment, uint index) {
    if (feature(FEATURE_MOTION) && moment == MUTANT(PREVIOUS_PUNCTUAL_CURRENT, MOMENT_PREVIOUS, NONE)) {
        return load_previous_punctual_lights(index);
    }
    return load_punctual_lights(index);
}

/// Whether rays pass through the emitter in places, by its alpha.
FN bool may_be_passed(IN(EmissiveTriangle) light) {
    if (!feature(FEATURE_ALPHA) || !feature(FEATURE_EMISSIVE_TEXTURES) || (light.flags & EMITTER_VARIES) == 0u) {
        return false;
    }
    uint flags = load_materials(load_geometries(light.geometry).material).flags;
    return (flags & (MATERIAL_ALPHA_MASK | MATERIAL_ALPHA_BLEND)) != 0u;
}

FN SeenLight see_emitter(IN(EmissiveTriangle) light, vec2 barycentrics, vec3 reference) {
    SeenLight s = unseen_light();
    vec3 point = light.vertex_0 + barycentrics.x * light.edge_1 + barycentrics.y * light.edge_2;
    vec3 to_light = point - reference;
    float facing = -dot(light.front, to_light);
    float squared = dot(to_light, to_light);
    if (!(squared > 0.0f) || (facing <= 0.0f && (light.flags & EMITTER_TWO_SIDED) == 0u)) {
        return s;
    }
    float inverse = inversesqrt(squared);
    s.direction = to_light * inverse;
    s.measure = light.double_area * abs(facing) * inverse * inverse * inverse;
    s.radiance = emitter_radiance(light, barycentrics);
    s.by_chance = MUTANT(PASSABLE_BY_CHANCE, !may_be_passed(light), true);
    s.end = emitter_end(light, point, facing < 0.0f);
    return s;
}

FN SeenLight see_light_point(IN(LightPoint) y, vec3 reference, uint moment) {
    SeenLight s = unseen_light();
    if (y.light >= constants.light_count) {
        return s;
    }
    if (feature(FEATURE_EMISSIVE) && y.light < constants.emissive_triangle_count) {
        return see_emitter(emissive_triangle_at(moment, y.light), y.uv, reference);
    }
    uint index = y.light - constants.emissive_triangle_count;
    if (feature(FEATURE_PUNCTUAL) && index < constants.punctual_light_count) {
        LightSample light = see_punctual(punctual_light_at(moment, index), reference);
        s.direction = light.direction;
        s.radiance = light.radiance;
        s.measure = light.pdf > 0.0f ? 1.0f : 0.0f;
        s.distant = light.distant;
        s.end = light.end;
        return s;
    }
    s.direction = uv_direction(y.uv);
    s.radiance = environment_radiance(s.direction);
    s.measure = 2.0f * PI;
    s.by_chance = true;
    s.distant = true;
    return s;
}

/// A light point, and its density per uv with the pick of its light by power; 0: none.
struct LightPointSample {
    LightPoint point;
    float pdf;
};

/// A light by power; `words` are two. There must be lights.
FN uint pick_light_by_power(uvec2 words) {
    uint column = alias_column(words.x, constants.light_count);
    return alias_pick(load_light_table(column), column, words.y);
}

/// A point of light `id`: triangles uniformly by area, the environment by its map. `more` are two random words for that.
FN LightPointSample sample_light_point(uint id, vec2 u, uvec2 more) {
    LightPointSample s;
    s.point = no_light_point();
    s.point.light = id;
    if (feature(FEATURE_EMISSIVE) && id < constants.emissive_triangle_count) {
        bool folded = u.x + u.y > 1.0f;
        s.point.uv = folded ? vec2(1.0f - u.x, 1.0f - u.y) : u;
        s.pdf = 2.0f * load_emissive_triangles(id).pmf;
        return s;
    }
    uint index = id - constants.emissive_triangle_count;
    if (feature(FEATURE_PUNCTUAL) && index < constants.punctual_light_count) {
        s.pdf = load_punctual_lights(index).pmf;
        return s;
    }
    LightSample light = sample_environment_direction(more, u);
    s.point.uv = direction_uv(light.direction);
    s.pdf = light.pdf * (2.0f * PI);
    return s;
}

/// Density per uv with which sample_light_point finds `y`, its light picked by power.
FN float pdf_light_point(IN(LightPoint) y) {
    if (feature(FEATURE_EMISSIVE) && y.light < constants.emissive_triangle_count) {
        return 2.0f * load_emissive_triangles(y.light).pmf;
    }
    uint index = y.light - constants.emissive_triangle_count;
    if (feature(FEATURE_PUNCTUAL) && index < constants.punctual_light_count) {
        return load_punctual_lights(index).pmf;
    }
    return pdf_environment(uv_direction(y.uv)) * (2.0f * PI);
}

#endif
