// Radiance to display: operators on linear Rec.709, then the sRGB curve.
#ifndef TONEMAP_H
#define TONEMAP_H

#include "numbers/elementary.h"

SHARED_BEGIN

CONST uint TONEMAP_NONE = 0u;
CONST uint TONEMAP_EXPONENTIAL = 1u;
CONST uint TONEMAP_UNCHARTED2 = 2u;
CONST uint TONEMAP_ACES = 3u;
CONST uint TONEMAP_PBR_NEUTRAL = 4u;

/// NaN and negative values become 0. Huge values are clamped where every operator has saturated.
FN float tonemap_input(float x) {
    return x > 0.0f ? min(x, 1.0e6f) : 0.0f;
}

FN float tonemap_exponential(float x) {
    return 1.0f - exp2_poly(-x * LOG2_E);
}

/// Hable 2010, "Uncharted 2: HDR Lighting": the curve without its white scale.
FN float hable_curve(float x) {
    return (x * (0.15f * x + 0.05f) + 0.004f) / (x * (0.15f * x + 0.5f) + 0.06f) - 0.02f / 0.3f;
}

/// hable_curve with Hable's exposure of 2, scaled to white at 11.2.
FN float tonemap_uncharted2(float x) {
    return max(hable_curve(2.0f * x) / hable_curve(11.2f), 0.0f);
}

/// Narkowicz 2015, "ACES Filmic Tone Mapping Curve".
FN float tonemap_aces(float x) {
    return clamp((x * (2.51f * x + 0.03f)) / (x * (2.43f * x + 0.59f) + 0.14f), 0.0f, 1.0f);
}

/// Khronos PBR Neutral 2024: subtracts the Fresnel reflection of a white environment, then compresses values above 0.8
/// toward white.
FN vec3 tonemap_pbr_neutral(vec3 color) {
    float least = min(color.x, min(color.y, color.z));
    float offset = least < 0.08f ? least - 6.25f * least * least : 0.04f;
    vec3 shifted = color - vec3(offset, offset, offset);
    float peak = max_component(shifted);
    if (peak < 0.76f) {
        return shifted;
    }
    float new_peak = 1.0f - 0.0576f / (peak + 0.24f - 0.76f);
    float keep = 1.0f / (0.15f * (peak - new_peak) + 1.0f);
    return shifted * (keep * new_peak / peak) + vec3(1.0f, 1.0f, 1.0f) * (new_peak * (1.0f - keep));
}

/// Display-linear colour. It is in [0, 1], except under TONEMAP_NONE, which changes nothing, and TONEMAP_UNCHARTED2
/// beyond its white.
FN vec3 tonemap(uint op, vec3 radiance) {
    vec3 x = vec3(tonemap_input(radiance.x), tonemap_input(radiance.y), tonemap_input(radiance.z));
    if (op == TONEMAP_EXPONENTIAL) {
        return vec3(tonemap_exponential(x.x), tonemap_exponential(x.y), tonemap_exponential(x.z));
    }
    if (op == TONEMAP_UNCHARTED2) {
        return vec3(tonemap_uncharted2(x.x), tonemap_uncharted2(x.y), tonemap_uncharted2(x.z));
    }
    if (op == TONEMAP_ACES) {
        return vec3(tonemap_aces(x.x), tonemap_aces(x.y), tonemap_aces(x.z));
    }
    if (op == TONEMAP_PBR_NEUTRAL) {
        return tonemap_pbr_neutral(x);
    }
    return radiance;
}

/// IEC 61966-2-1, [0, 1] to [0, 1]. The input is clamped; NaN gives 0.
FN float srgb_encode_component(float x) {
    float linear = x > 0.0f ? min(x, 1.0f) : 0.0f;
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * pow_poly(linear, 1.0f / 2.4f) - 0.055f;
}

FN vec3 srgb_encode(vec3 linear) {
    return vec3(srgb_encode_component(linear.x), srgb_encode_component(linear.y), srgb_encode_component(linear.z));
}

/// The inverse of srgb_encode_component, for encoded values >= 0.
FN float srgb_decode(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : pow_poly((encoded + 0.055f) / 1.055f, 2.4f);
}

SHARED_END

#endif
