#version 460
#extension GL_GOOGLE_include_directive : require

#include "probes_numbers.h"

#define PROBES NUMBER_PROBES
#include "parity_main.glsl"
