#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_tracing : require

#include "payload.glsl"

layout(location = SHADOW_PAYLOAD) rayPayloadInEXT ShadowPayload payload;

void main() { payload.missed = 1u; }
