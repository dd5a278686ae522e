// Punctual lights (KHR_lights_punctual).
#ifndef PUNCTUAL_KERNEL_H
#define PUNCTUAL_KERNEL_H

#include "leaves.h"

/// The light at the current moment, or at the previous one, for reuse from the frame before.
FN PunctualLight punctual_light_at(uint moment, uint index) {
    if (feature(FEATURE_MOTION) && moment == MUTANT(PREVIOUS_PUNCTUAL_CURRENT, MOMENT_PREVIOUS, NONE)) {
        return load_previous_punctual_lights(index);
    }
    return load_punctual_lights(index);
}

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

/// The light as a light point. Its uv are unused.
FN SeenLight see_punctual_point(IN(PunctualLight) light, vec3 reference) {
    LightSample sampled = see_punctual(light, reference);
    SeenLight s = unseen_light();
    s.direction = sampled.direction;
    s.radiance = sampled.radiance;
    s.measure = sampled.pdf > 0.0f ? 1.0f : 0.0f;
    s.distant = sampled.distant;
    s.end = sampled.end;
    return s;
}

#endif
