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

/// Right-handed, for a unit normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited"). The frame turns where n.z
/// passes the bound; a bound of 0 would lie in every wall that stands along z, where rounding, and so the backend, would choose.
FN Frame frame_from_normal(vec3 n) {
    // The sign by its bit: walls come in both kinds, and a CPU would guess.
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
