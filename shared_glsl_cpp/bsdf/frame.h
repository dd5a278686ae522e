// Orthonormal frames about a normal.
#ifndef FRAME_H
#define FRAME_H

#include "language/compat.h"

SHARED_BEGIN

struct Frame {
    vec3 tangent;
    vec3 bitangent;
    vec3 normal;
};

/// Right-handed frame about a unit normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited"). The tangents
/// flip where n.z passes -1/16. A threshold of 0 would be met by every wall that is parallel to the z axis; there
/// rounding decides the sign, and the backends round differently.
FN Frame frame_from_normal(vec3 n) {
    // The sign is taken from the bit, without a branch: both signs are common, so a CPU would mispredict.
    float side = uintBitsToFloat(0x3f800000u | (floatBitsToUint(n.z + 0.0625f) & 0x80000000u));
    PRECISE float a = -1.0f / (side + n.z);
    PRECISE float b = n.x * n.y * a;
    PRECISE vec3 tangent = vec3(1.0f + side * n.x * n.x * a, side * b, -side * n.x);
    PRECISE vec3 bitangent = vec3(b, side + n.y * n.y * a, -n.y);
    Frame frame;
    frame.tangent = tangent;
    frame.bitangent = bitangent;
    frame.normal = n;
    return frame;
}

FN vec3 to_local(IN(Frame) frame, vec3 world) {
    return vec3(dot(world, frame.tangent), dot(world, frame.bitangent), dot(world, frame.normal));
}

FN vec3 to_world(IN(Frame) frame, vec3 local) {
    return local.x * frame.tangent + local.y * frame.bitangent + local.z * frame.normal;
}

SHARED_END

#endif
