// Lights: picked by power through one alias table; sampled; and the density of having been sampled, found from a hit's ids in O(1).
#ifndef LIGHT_KERNEL_H
#define LIGHT_KERNEL_H

#include "geometry/surface.kernel.h"

/// A point on a light as `reference` sees it.
struct LightSample {
    vec3 direction;  // unit, toward the light
    vec3 radiance;   // arriving unoccluded; of a delta light: already divided by r², to be divided by pdf alone
    float pdf;       // solid angle times pick; of a delta light: pick alone. 0: no light
    bool delta;      // no other strategy can find it
    bool distant;    // at infinity: no end point
    vec3 end;        // where the shadow ray ends, offset from the light's surface
};

FN LightSample no_light() {
    LightSample s;
    s.direction = vec3(0.0f, 0.0f, 1.0f);
    s.radiance = vec3(0.0f, 0.0f, 0.0f);
    s.pdf = 0.0f;
    s.delta = false;
    s.distant = false;
    s.end = vec3(0.0f, 0.0f, 0.0f);
    return s;
}

// Environment

FN vec4 environment_texel(int x, int y) {
    int w = int(constants.environment.size.x);
    int h = int(constants.environment.size.y);
    int column = x < 0 ? x + w : (x >= w ? x - w : x);
    int row = clamp(y, 0, h - 1);
    return load_environment_texels(uint(row * w + column));
}

/// Radiance from infinity against `direction`, bilinear between texel centres.
FN vec3 environment_radiance(vec3 direction) {
    if (feature(FEATURE_ENVIRONMENT_MAP) && constants.environment.kind == ENVIRONMENT_MAP) {
        vec2 uv = environment_uv(direction, constants.environment.rotation);
        float x = uv.x * float(constants.environment.size.x) - 0.5f;
        float y = uv.y * float(constants.environment.size.y) - 0.5f;
        float left = floor(x);
        float top = floor(y);
        float s = x - left;
        float t = y - top;
        vec3 a = xyz(environment_texel(int(left), int(top)));
        vec3 b = xyz(environment_texel(int(left) + 1, int(top)));
        vec3 c = xyz(environment_texel(int(left), int(top) + 1));
        vec3 d = xyz(environment_texel(int(left) + 1, int(top) + 1));
        return constants.environment.scale * ((1.0f - t) * ((1.0f - s) * a + s * b) + t * ((1.0f - s) * c + s * d));
    }
    if (feature(FEATURE_CONSTANT_ENVIRONMENT) && constants.environment.kind == ENVIRONMENT_CONSTANT) {
        return constants.environment.scale;
    }
    return vec3(0.0f, 0.0f, 0.0f);
}

/// Density per solid angle, pick included, with which sample_environment finds `direction` in a texel of this probability.
FN float pdf_environment_texel(float texel_pmf, vec3 direction) {
    float sin_theta = sqrt(direction.x * direction.x + direction.z * direction.z);  // keeps its digits at the poles
    return constants.environment.pmf * pdf_environment_solid_angle(texel_pmf, constants.environment.size, sin_theta);
}

/// Density per solid angle, pick included, with which sample_environment finds `direction`.
FN float pdf_environment(vec3 direction) {
    if (feature(FEATURE_ENVIRONMENT_MAP) && constants.environment.kind == ENVIRONMENT_MAP) {
        uvec2 size = constants.environment.size;
        vec2 uv = environment_uv(direction, constants.environment.rotation);
        int x = int(min(uv.x * float(size.x), float(size.x - 1u)));
        int y = int(min(uv.y * float(size.y), float(size.y - 1u)));
        return pdf_environment_texel(environment_texel(x, y).w, direction);
    }
    return constants.environment.pmf * (0.25f * INV_PI);
}

/// `more` are two random words for the map's alias table. Without its radiance.
FN LightSample sample_environment_direction(uvec2 more, vec2 u) {
    LightSample s = no_light();
    s.distant = true;
    if (feature(FEATURE_ENVIRONMENT_MAP) && constants.environment.kind == ENVIRONMENT_MAP) {
        uvec2 size = constants.environment.size;
        uint column = alias_column(more.x, size.x * size.y);
        uint texel = alias_pick(load_environment_table(column), column, more.y);
        float x = (float(texel % size.x) + u.x) / float(size.x);
        float y = (float(texel / size.x) + u.y) / float(size.y);
        s.direction = environment_direction(vec2(x, y), constants.environment.rotation);
        // Of the texel picked, though its edge may round into a dimmer neighbour.
        s.pdf = pdf_environment_texel(load_environment_texels(texel).w, s.direction);
    } else {
        s.direction = sample_uniform_sphere(u);
        s.pdf = pdf_environment(s.direction);
    }
    return s;
}

FN LightSample sample_environment(IN(Sampler) random, uint dimension, vec2 u) {
    uvec2 more = uvec2(0u, 0u);
    if (feature(FEATURE_ENVIRONMENT_MAP) && constants.environment.kind == ENVIRONMENT_MAP) {
        more = sample_bits_2d(random, dimension + DIMENSION_ENVIRONMENT);
    }
    LightSample s = sample_environment_direction(more, u);
    s.radiance = environment_radiance(s.direction);
    return s;
}

// Emissive triangles

/// Density per solid angle, pick included, with which sample_emitter finds `point` of the triangle from `reference`.
FN float pdf_emitter(IN(EmissiveTriangle) light, vec3 reference, vec3 point) {
    PRECISE vec3 to_vertex_0 = light.vertex_0 - reference;
    TriangleView view = triangle_view(to_vertex_0, light.edge_1, light.edge_2, light.front, light.double_area);
    return light.pmf * pdf_triangle_view(view, point - reference);
}

/// Emitted radiance at barycentrics of a light, times its coverage where it is not opaque: a ray that finds it there would have
/// passed with the complement.
FN vec3 emitter_radiance(IN(EmissiveTriangle) light, vec2 barycentrics) {
    if (!feature(FEATURE_EMISSIVE_TEXTURES) || (light.flags & EMITTER_VARIES) == 0u) {
        return light.radiance;
    }
    LOCAL(Geometry) geometry = load_geometries(light.geometry);
    LOCAL(Material) material = load_materials(geometry.material);
    MeshPoint p = mesh_point(geometry, light.primitive, barycentrics);
    // The light's own factor, not the material's: the light may be of the moment before.
    vec3 radiance = (material.flags & MATERIAL_UNLIT) != 0u ? xyz(base_color(material, p))
                                                            : light.radiance * xyz(slot_value(material.emission_slot, p));
    if (feature(FEATURE_ALPHA) && (material.flags & (MATERIAL_ALPHA_MASK | MATERIAL_ALPHA_BLEND)) != 0u) {
        radiance = radiance * MUTANT(EMITTER_UNCOVERED, opacity(material, base_color(material, p).w), 1.0f);
    }
    return radiance;
}

/// Whether the back of the light, or its edge, is what `reference` sees.
FN bool is_behind(IN(EmissiveTriangle) light, vec3 reference) {
    return dot(light.vertex_0 - reference, light.front) >= 0.0f;
}

/// A point of the light, off its surface on the side that emits, or on the other.
FN vec3 emitter_end(IN(EmissiveTriangle) light, vec3 point, bool behind) {
    vec3 magnitude = abs(light.vertex_0) + abs(light.edge_1) + abs(light.edge_2);
    return offset_ray(point, behind ? -light.front : light.front, magnitude);
}

/// A point of the light, as triangle_sampling.h picks it.
FN TriangleSample sample_emitter_point(IN(EmissiveTriangle) light, vec3 reference, vec2 u) {
    PRECISE vec3 to_vertex_0 = light.vertex_0 - reference;
    TriangleView view = triangle_view(to_vertex_0, light.edge_1, light.edge_2, light.front, light.double_area);
    return sample_triangle_view(view, to_vertex_0, light.edge_1, light.edge_2, u);
}

/// The light at a point by sample_emitter_point.
FN LightSample sample_emitter(IN(EmissiveTriangle) light, vec3 reference, IN(TriangleSample) t) {
    LightSample s = no_light();
    if (!(t.pdf > 0.0f)) {
        return s;
    }
    vec3 point = light.vertex_0 + t.barycentrics.x * light.edge_1 + t.barycentrics.y * light.edge_2;
    s.direction = normalize_or(point - reference, light.front);
    s.radiance = emitter_radiance(light, t.barycentrics);
    s.pdf = MUTANT(NO_LIGHT_PICK_PDF, light.pmf, 1.0f) * t.pdf;
    vec3 end = MUTANT(SHADOW_RAY_TO_WRONG_LIGHT, point, load_emissive_triangles(0u).vertex_0);
    s.end = emitter_end(light, end, is_behind(light, reference));
    return s;
}

// Punctual lights (KHR_lights_punctual)

FN LightSample see_punctual(IN(PunctualLight) light, vec3 reference) {
    LightSample s = no_light();
    s.delta = true;
    s.pdf = light.pmf;
    if (light.type == PUNCTUAL_DIRECTIONAL) {
        s.distant = true;
        s.direction = -light.direction;
        s.radiance = light.intensity;
        return s;
    }
    vec3 to_light = light.position - reference;
    float distance_squared = dot(to_light, to_light);
    if (!(distance_squared > 0.0f)) {
        return no_light();
    }
    s.direction = to_light * inversesqrt(distance_squared);
    s.end = light.position;
    s.radiance = light.intensity / distance_squared;
    if (light.type == PUNCTUAL_SPOT) {
        float falloff = clamp(-dot(s.direction, light.direction) * light.cone_scale + light.cone_offset, 0.0f, 1.0f);
        s.radiance = s.radiance * (falloff * falloff);
    }
    return s;
}

// Any light. `draws` are the vertex's first four pairs (dimensions.h).

FN bool is_emitter(uint id) { return feature(FEATURE_EMISSIVE) && id < constants.emissive_triangle_count; }

/// A light in proportion to its power (and a defensive share of uniform picking); NONE where that shows a back that does not emit.
FN uint pick_light(vec3 reference, IN(FourPairs) draws) {
    if (constants.light_count == 0u) {
        return NONE;
    }
    uint column = alias_column(draws.first.z, constants.light_count);
    uint id = alias_pick(load_light_table(column), column, draws.second.z);
    RECORD(light, id);
    if (is_emitter(id)) {
        LOCAL(EmissiveTriangle) light = load_emissive_triangles(id);
        bool one_sided = MUTANT(ONE_SIDED_AS_TWO_SIDED, (light.flags & EMITTER_TWO_SIDED) == 0u, false);
        return one_sided && is_behind(light, reference) ? NONE : id;
    }
    return id;
}

/// Where on a light.
FN vec2 light_point_draws(IN(FourPairs) draws) { return vec2(unit_float(draws.first.w), unit_float(draws.second.w)); }

/// The light picked, at a point of it: of an emitter, at `on_emitter`. `dimension` is the vertex's first.
FN LightSample sample_light(uint picked, IN(TriangleSample) on_emitter, vec3 reference, IN(FourPairs) draws,
                            IN(Sampler) random, uint dimension) {
    if (is_emitter(picked)) {
        return sample_emitter(load_emissive_triangles(picked), reference, on_emitter);
    }
    uint id = picked - constants.emissive_triangle_count;
    if (feature(FEATURE_PUNCTUAL) && id < constants.punctual_light_count) {
        return see_punctual(load_punctual_lights(id), reference);
    }
    return sample_environment(random, dimension, light_point_draws(draws));
}

#endif
