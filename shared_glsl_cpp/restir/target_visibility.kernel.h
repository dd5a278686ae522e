// The target with its visibility: whether a surface sees a light point, and whether the target asks (`--reuse-visibility target`). A pass
// that is compiled with REUSE_WITHOUT_RAYS serves settings under which the target does not ask, and holds no code for rays.
#ifndef TARGET_VISIBILITY_KERNEL_H
#define TARGET_VISIBILITY_KERNEL_H

#include "lights/light.kernel.h"

#ifdef REUSE_WITHOUT_RAYS

FN bool target_sees(vec3 origin, IN(SeenLight) light, IN(LightPoint) y, uint moment, INOUT(uint) rays) { return true; }

#else

/// Names the shadow rays to a light point: whether they pass stochastic alpha is a property of the point, the same for every surface.
FN uint visibility_key(IN(LightPoint) y) {
    if (!feature(FEATURE_ALPHA)) {
        return 0u;
    }
    return pcg4d(uvec4(y.light, floatBitsToUint(y.uv.x), floatBitsToUint(y.uv.y), constants.seed)).x >> 1;
}

/// Whether the light point is hidden now from a ray of that key.
FN bool is_light_hidden(vec3 origin, IN(SeenLight) light, uint alpha_key) {
    vec3 direction = light.distant ? light.direction : light.end - origin;
    return trace_any(origin, direction, light.distant ? INFINITE_DISTANCE : 0.9999f, alpha_key);
}

/// Whether the target function treats the light point as occluded.
FN bool is_light_occluded(vec3 origin, IN(SeenLight) light, IN(LightPoint) y, uint moment) {
    if (feature(FEATURE_MOTION) && moment == MUTANT(REUSE_CURRENT_OCCLUDERS, MOMENT_PREVIOUS, NONE)) {
        vec3 direction = light.distant ? light.direction : light.end - origin;
        float t_max = light.distant ? INFINITE_DISTANCE : 0.9999f;
        return trace_any_previous(origin, direction, t_max, visibility_key(y));
    }
    return is_light_hidden(origin, light, visibility_key(y));
}

/// Whether the target lets it shine on the surface: always, unless it asks for visibility. Counts the ray that this takes.
FN bool target_sees(vec3 origin, IN(SeenLight) light, IN(LightPoint) y, uint moment, INOUT(uint) rays) {
    if (!feature(FEATURE_TARGET_VISIBILITY) || constants.resampling.visibility != VISIBILITY_IN_TARGET) {
        return true;
    }
    rays += 1u;
    return !is_light_occluded(origin, light, y, moment);
}

#endif

/// p̂ of a light point at a surface, among the lights and occluders of `moment`. Counts the rays it needs.
FN float target_at(IN(TargetSurface) s, IN(LightPoint) y, uint moment, INOUT(uint) rays) {
    SeenLight light = see_light_point(y, s.position, moment);
    float target = unoccluded_target(s, light);
    return target > TARGET_MIN && target_sees(s.position, light, y, moment, rays) ? target : 0.0f;
}

#endif
