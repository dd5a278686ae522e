// Ray payloads. The alpha key goes in, to the any-hit shaders; the result comes out.
#ifndef PAYLOAD_GLSL
#define PAYLOAD_GLSL

#include "geometry/hit.h"

#define CLOSEST_PAYLOAD 0
#define SHADOW_PAYLOAD 1

// The closest-hit payload is a Hit. Its `instance` holds the alpha key until the trace ends.

struct ShadowPayload {
    uint alpha_key;
    uint missed;
};

#endif
