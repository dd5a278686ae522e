#version 460
#extension GL_GOOGLE_include_directive : require

#include "probes_bsdf.h"

#define PROBES BSDF_PROBES
#include "parity_main.glsl"
