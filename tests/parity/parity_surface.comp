#version 460
#extension GL_GOOGLE_include_directive : require

#include "probes_surface.h"

#define PROBES SURFACE_PROBES
#include "parity_main.glsl"
