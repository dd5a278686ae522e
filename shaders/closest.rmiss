#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_tracing : require

#include "payload.glsl"

layout(location = CLOSEST_PAYLOAD) rayPayloadInEXT Hit payload;

void main() { payload.instance = NONE; }
