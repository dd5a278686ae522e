// What a ray carries. The alpha key travels inward to the any-hit shaders, the answer outward.
#ifndef PAYLOAD_GLSL
#define PAYLOAD_GLSL

#include "geometry/hit.h"

#define CLOSEST_PAYLOAD 0
#define SHADOW_PAYLOAD 1

// The closest-hit payload is a Hit whose `instance` is the alpha key until the trace ends.

struct ShadowPayload {
    uint alpha_key;
    uint missed;
};

#endif
