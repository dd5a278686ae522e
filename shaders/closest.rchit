#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_tracing : require

#include "hit_ids.glsl"
#include "payload.glsl"

layout(location = CLOSEST_PAYLOAD) rayPayloadInEXT Hit payload;
hitAttributeEXT vec2 barycentrics;

void main() {
    uvec2 ids = hit_ids();
    payload.instance = ids.x;
    payload.geometry = ids.y;
    payload.primitive = gl_PrimitiveID;
    payload.barycentrics = barycentrics;
    payload.t = gl_HitTEXT;
}
