#version 460
#extension GL_GOOGLE_include_directive : require

#include "probes_resampling.h"

#define PROBES RESAMPLING_PROBES
#include "parity_main.glsl"
