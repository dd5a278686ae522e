#version 460
#extension GL_GOOGLE_include_directive : require

#include "probes_sampling.h"

#define PROBES SAMPLING_PROBES
#include "parity_main.glsl"
