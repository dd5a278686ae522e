// The parameters of the display pass, in scalar layout for GLSL and C++.
#ifndef DISPLAY_H
#define DISPLAY_H

#include "language/compat.h"

SHARED_BEGIN

/// Device addresses as pairs of words, low word first; {0, 0} means that there is no such buffer.
struct DisplayFilm {
    uvec2 pixels;
    uvec2 moments;
    uvec2 first_hits;
    uvec2 reservoirs;  // of the set to show
    uvec2 size;        // pixels
};
ASSERT_SIZE(DisplayFilm, 40);

/// The push constants.
struct Display {
    DisplayFilm left;
    DisplayFilm right;
    uvec2 size;      // of the picture, pixels
    uint divider;    // first column that shows `right`
    uint layer;      // LAYER_…
    uint flags;      // DISPLAY_…
    uint tonemap;    // TONEMAP_…
    float exposure;  // factor on radiance
    float low;       // lower end of a scalar layer's colour ramp; `high` is the upper end
    float high;
};
ASSERT_SIZE(Display, 116);

/// Histogram of the values shown, by magnitude. Bins are a quarter octave wide and start at 2^-32. Values outside are
/// counted in the first or last bin.
CONST uint HISTOGRAM_BINS = 256u;
CONST uint HISTOGRAM_FIRST = (127u - 32u) << 2;  // the bin of a float is (its bits >> 21) - HISTOGRAM_FIRST

CONST uint DISPLAY_DIFFERENCE = 1u;   // left - right
CONST uint DISPLAY_LOGARITHMIC = 2u;  // the ramp is logarithmic

CONST uint LAYER_RADIANCE = 0u;
CONST uint LAYER_ALBEDO = 1u;
CONST uint LAYER_NORMAL = 2u;
CONST uint LAYER_DEPTH = 3u;
CONST uint LAYER_STANDARD_ERROR = 4u;
CONST uint LAYER_SAMPLES = 5u;
CONST uint LAYER_NONFINITE = 6u;
CONST uint LAYER_LIGHT_ID = 7u;
CONST uint LAYER_RESERVOIR_M = 8u;
CONST uint LAYER_RESERVOIR_W = 9u;

SHARED_END

#endif
