// The colours of layers other than radiance, in display values. The legend beside the picture uses them too.
#ifndef DISPLAY_COLORS_H
#define DISPLAY_COLORS_H

#include "numbers/elementary.h"
#include "film/magma.h"
#include "numbers/rng.h"

SHARED_BEGIN

/// Dark to bright for t from 0 to 1: the colour map magma of heat maps.
FN vec3 ramp_color(float t) {
    float position = 15.0f * min(max(t, 0.0f), 1.0f);
    vec3 color = vec3(0.0f, 0.0f, 0.0f);
    float entry = 0.0f;
    // Sums all entries, each weighted by a tent function. A lookup would need an array, and GLSL and C++ write arrays
    // differently.
#define ADD_ENTRY(r, g, b)                                                                                             \
    color += max(1.0f - abs(position - entry), 0.0f) * vec3(r, g, b);                                                  \
    entry += 1.0f;
    MAGMA_ENTRIES(ADD_ENTRY)
#undef ADD_ENTRY
    return color;
}

/// Blue at -1, black at 0, red at 1.
FN vec3 signed_color(float t) {
    float strength = sqrt(min(abs(t), 1.0f));
    return t < 0.0f ? strength * vec3(0.25f, 0.6f, 1.0f) : strength * vec3(1.0f, 0.35f, 0.2f);
}

/// A hue for every number, bright enough on black. Numbers may share a hue.
FN vec3 id_color(uint id) {
    uint bits = hash_combine(id, 0x9e3779b9u);
    float hue = 6.0f * unit_float(bits);
    float r = abs(hue - 3.0f) - 1.0f;
    float g = 2.0f - abs(hue - 2.0f);
    float b = 2.0f - abs(hue - 4.0f);
    vec3 pure = vec3(clamp(r, 0.0f, 1.0f), clamp(g, 0.0f, 1.0f), clamp(b, 0.0f, 1.0f));
    float value = 0.7f + 0.3f * unit_float(hash_combine(id, 0x85ebca6bu));
    return value * (0.25f * vec3(1.0f, 1.0f, 1.0f) + 0.75f * pure);
}

/// Background where there is no film or no layer: squares of 16 pixels.
FN vec3 checkerboard(uvec2 pixel) {
    float level = ((pixel.x / 16u + pixel.y / 16u) & 1u) == 0u ? 0.16f : 0.2f;
    return vec3(level, level, level);
}

/// The colour of a number that is not finite, as in heat maps.
FN vec3 nonfinite_color() {
    return vec3(0.0f, 1.0f, 1.0f);
}

SHARED_END

#endif
