// The environment as a light: its radiance, sampled directions, and light points.
#ifndef ENVIRONMENT_KERNEL_H
#define ENVIRONMENT_KERNEL_H

#include "leaves.h"

FN vec4 environment_texel(int x, int y) {
    int w = int(constants.environment.size.x);
    int h = int(constants.environment.size.y);
    int column = x < 0 ? x + w : (x >= w ? x - w : x);
    int row = clamp(y, 0, h - 1);
    return load_environment_texels(uint(row * w + column));
}

/// Radiance that arrives from `direction`, interpolated bilinearly between texel centres.
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

/// Density per solid angle with which sample_environment finds `direction` in a texel of probability `texel_pmf`, if
/// the environment is picked with probability `pmf`.
FN float pdf_environment_texel(float pmf, float texel_pmf, vec3 direction) {
    float sin_theta = sqrt(direction.x * direction.x + direction.z * direction.z);  // accurate near the poles
    return pmf * pdf_environment_solid_angle(texel_pmf, constants.environment.size, sin_theta);
}

/// Density per solid angle with which sample_environment finds `direction`, if the environment is picked with
/// probability `pmf`.
FN float pdf_environment(float pmf, vec3 direction) {
    if (feature(FEATURE_ENVIRONMENT_MAP) && constants.environment.kind == ENVIRONMENT_MAP) {
        uvec2 size = constants.environment.size;
        vec2 uv = environment_uv(direction, constants.environment.rotation);
        int x = int(min(uv.x * float(size.x), float(size.x - 1u)));
        int y = int(min(uv.y * float(size.y), float(size.y - 1u)));
        return pdf_environment_texel(pmf, environment_texel(x, y).w, direction);
    }
    return pmf * (0.25f * INV_PI);
}

/// Samples a direction, if the environment was picked with probability `pmf`; the caller sets the radiance. `more` are
/// two random words for the map's alias table.
FN LightSample sample_environment_direction(float pmf, uvec2 more, vec2 u) {
    LightSample s = no_light();
    s.distant = true;
    if (feature(FEATURE_ENVIRONMENT_MAP) && constants.environment.kind == ENVIRONMENT_MAP) {
        uvec2 size = constants.environment.size;
        uint column = alias_column(more.x, size.x * size.y);
        uint texel = alias_pick(load_environment_table(column), column, more.y);
        float x = (float(texel % size.x) + u.x) / float(size.x);
        float y = (float(texel / size.x) + u.y) / float(size.y);
        s.direction = environment_direction(vec2(x, y), constants.environment.rotation);
        // The pdf of the texel that was picked: at its edge the direction may round into a neighbour.
        s.pdf = pdf_environment_texel(pmf, load_environment_texels(texel).w, s.direction);
    } else {
        s.direction = sample_uniform_sphere(u);
        s.pdf = pdf_environment(pmf, s.direction);
    }
    return s;
}

FN LightSample sample_environment(float pmf, IN(Sampler) random, uint dimension, vec2 u) {
    uvec2 more = uvec2(0u, 0u);
    if (feature(FEATURE_ENVIRONMENT_MAP) && constants.environment.kind == ENVIRONMENT_MAP) {
        more = sample_bits_2d(random, dimension + DIMENSION_ENVIRONMENT);
    }
    LightSample s = sample_environment_direction(pmf, more, u);
    s.radiance = environment_radiance(s.direction);
    return s;
}

/// A direction as uv: x is 1 - |z| with the sign of z; y is the angle about z, in [0, 1). Accurate at both poles.
/// Every unit of uv covers 2 pi sr.
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

FN SeenLight see_environment(vec2 uv) {
    SeenLight s = unseen_light();
    s.direction = uv_direction(uv);
    s.radiance = environment_radiance(s.direction);
    s.measure = 2.0f * PI;
    s.by_chance = true;
    s.distant = true;
    return s;
}

#endif
