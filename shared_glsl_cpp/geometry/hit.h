// What tracing returns: ids and barycentrics only; positions are rebuilt from them, exactly, by `surface.kernel.h`.
#ifndef HIT_H
#define HIT_H

#include "language/compat.h"

SHARED_BEGIN

struct Hit {
    uint instance;      // NONE: a miss
    uint geometry;      // the primitive's place within its mesh
    uint primitive;     // triangle within the geometry
    vec2 barycentrics;  // of the second and third vertex
    float t;            // in lengths of the ray's direction
};
ASSERT_SIZE(Hit, 24);

SHARED_END

#endif
