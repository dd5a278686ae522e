// Computes the window's picture, pixel by pixel, from the film.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

#include "display.h"
#include "display_colors.h"
#include "film_values.glsl"
#include "film_words.glsl"
#include "restir/resampling_memory.h"
#include "film/tonemap.h"

layout(local_size_x = 16, local_size_y = 16) in;  // as many invocations as histogram bins
layout(set = 0, binding = 0, rgba8) uniform writeonly image2D picture;
layout(push_constant, scalar) uniform Push { Display display; };

layout(set = 0, binding = 1, scalar) buffer Histogram { uint histogram[]; };
shared uint bins[HISTOGRAM_BINS];

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Reservoirs { Reservoir data[]; };

bool is_there(uvec2 address) { return (address.x | address.y) != 0u; }
bool is_finite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }
bool is_finite(vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

// The value of a layer at a pixel: a colour, or a number in x.
struct Value {
    bool known;
    vec3 v;
};

bool is_colored(uint layer) { return layer <= LAYER_NORMAL; }

Value value_of(DisplayFilm film, uvec2 picture_pixel) {
    Value value;
    value.known = false;
    value.v = vec3(0.0f);
    if (!is_there(film.pixels)) {
        return value;
    }
    uvec2 at = min((picture_pixel * 2u + 1u) * film.size / (display.size * 2u), film.size - 1u);
    uint index = at.y * film.size.x + at.x;
    uint layer = display.layer;
    if (layer == LAYER_RADIANCE || layer == LAYER_SAMPLES || layer == LAYER_NONFINITE) {
        FilmPixel pixel = load_film_pixel(film_pixel_place(film.pixels, index));
        value.known = true;
        value.v = layer == LAYER_RADIANCE  ? film_mean(pixel)
                  : layer == LAYER_SAMPLES ? vec3(float(pixel.samples))
                                           : vec3(float(pixel.nonfinite));
    } else if (layer == LAYER_STANDARD_ERROR && is_there(film.moments)) {
        value.known = true;
        FilmMoments moments;
        moments.squares = load_exact_sum(film_moments_place(film.moments, index));
        value.v = vec3(
            luminance(film_standard_error(load_film_pixel(film_pixel_place(film.pixels, index)), moments)));
    } else if ((layer == LAYER_ALBEDO || layer == LAYER_NORMAL || layer == LAYER_DEPTH) && is_there(film.first_hits)) {
        FilmFirstHit hit = load_film_first_hit(film_first_hit_place(film.first_hits, index));
        value.known = true;
        FilmPixel pixel = load_film_pixel(film_pixel_place(film.pixels, index));
        float n = max(1.0f, float(pixel.samples) + float(pixel.nonfinite));
        value.v = layer == LAYER_ALBEDO   ? film_mean(hit.albedo, n)
                  : layer == LAYER_NORMAL ? film_mean(hit.normal, n)
                                          : vec3(film_mean(hit.depth, n));
    } else if (layer >= LAYER_LIGHT_ID && is_there(film.reservoirs)) {
        Reservoir r = Reservoirs(film.reservoirs).data[index];
        value.known = true;
        value.v = layer == LAYER_LIGHT_ID      ? vec3(uintBitsToFloat(r.point.light))
                  : layer == LAYER_RESERVOIR_M ? vec3(r.confidence)
                                               : vec3(r.weight);
    }
    return value;
}

void count(float x) {
    if (abs(x) > 0.0f && is_finite(x)) {
        uint bin = floatBitsToUint(abs(x)) >> 21;
        atomicAdd(bins[clamp(bin, HISTOGRAM_FIRST, HISTOGRAM_FIRST + HISTOGRAM_BINS - 1u) - HISTOGRAM_FIRST], 1u);
    }
}

vec3 scalar_color(float x) {
    count(x);
    if (!is_finite(x)) {
        return nonfinite_color();
    }
    bool logarithmic = (display.flags & DISPLAY_LOGARITHMIC) != 0u;
    float t = logarithmic ? log2(max(x, display.low) / display.low) / log2(display.high / display.low)
                          : (x - display.low) / (display.high - display.low);
    return ramp_color(t);
}

vec3 color_of(vec3 v) {
    if (display.layer == LAYER_RADIANCE) {
        return srgb_encode(tonemap(display.tonemap, display.exposure * v));
    }
    if (display.layer == LAYER_ALBEDO) {
        return srgb_encode(v);
    }
    if (display.layer == LAYER_NORMAL) {
        return 0.5f * v + 0.5f;
    }
    if (display.layer == LAYER_LIGHT_ID) {
        uint id = floatBitsToUint(v.x);
        return id == NONE ? vec3(0.0f) : id_color(id);
    }
    return scalar_color(v.x);
}

vec3 difference_color(vec3 left, vec3 right) {
    if (display.layer == LAYER_LIGHT_ID) {
        return floatBitsToUint(left.x) == floatBitsToUint(right.x) ? vec3(0.0f) : vec3(1.0f);
    }
    float difference = is_colored(display.layer) ? luminance(left - right) : left.x - right.x;
    count(difference);
    return is_finite(difference) ? signed_color(difference / display.high) : nonfinite_color();
}

void show(uvec2 pixel) {
    bool difference = (display.flags & DISPLAY_DIFFERENCE) != 0u;
    bool on_right = !difference && pixel.x >= display.divider;
    Value shown;
    if (on_right) {
        shown = value_of(display.right, pixel);
    } else {
        shown = value_of(display.left, pixel);
    }
    vec3 color = checkerboard(pixel);
    if (difference) {
        Value other = value_of(display.right, pixel);
        if (shown.known && other.known) {
            color = difference_color(shown.v, other.v);
        }
    } else if (shown.known) {
        color = color_of(shown.v);
    }
    imageStore(picture, ivec2(pixel), vec4(color, 1.0f));
}

void main() {
    bins[gl_LocalInvocationIndex] = 0u;
    barrier();
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (pixel.x < display.size.x && pixel.y < display.size.y) {
        show(pixel);
    }
    barrier();
    uint counted = bins[gl_LocalInvocationIndex];
    if (counted > 0u) {
        atomicAdd(histogram[gl_LocalInvocationIndex], counted);
    }
}
