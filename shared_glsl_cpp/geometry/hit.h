// The result of tracing a ray: ids, barycentrics and distance. `surface.kernel.h` computes the position from the ids
// and the ray.
#ifndef HIT_H
#define HIT_H

#include "language/compat.h"

SHARED_BEGIN

struct Hit {
    uint instance;      // NONE for a miss
    uint geometry;      // index of the glTF primitive within its mesh
    uint primitive;     // index of the triangle within the geometry
    vec2 barycentrics;  // of the second and third vertex
    float t;            // in units of the length of the ray's direction
};
ASSERT_SIZE(Hit, 24);

SHARED_END

#endif
