// What a scene and its settings may need. A bit that is off removes the code (a specialization constant in GLSL) and
// the buffers that belong to it. A bit that is on only permits them; the data decide. So a render with every bit on
// (the setting `generic`) gives the same image.
#ifndef SCENE_FEATURES_H
#define SCENE_FEATURES_H

#include "language/compat.h"

// X(name for users, constant, bit)
#define FEATURE_LIST(X)                                \
    X("textures", FEATURE_TEXTURES, 0)                 \
    X("normal-maps", FEATURE_NORMAL_MAPS, 1)           \
    X("alpha", FEATURE_ALPHA, 2)                       \
    X("vertex-colors", FEATURE_VERTEX_COLORS, 3)       \
    X("second-uv-set", FEATURE_SECOND_UV, 4)           \
    X("emissive-triangles", FEATURE_EMISSIVE, 5)       \
    X("emissive-textures", FEATURE_EMISSIVE_TEXTURES, 6) \
    X("punctual-lights", FEATURE_PUNCTUAL, 7)          \
    X("constant-environment", FEATURE_CONSTANT_ENVIRONMENT, 8) \
    X("environment-map", FEATURE_ENVIRONMENT_MAP, 9)   \
    X("ggx", FEATURE_GGX, 10)                          \
    X("blinn-phong", FEATURE_BLINN_PHONG, 11)          \
    X("mirrors", FEATURE_MIRRORS, 12)                  \
    X("thin-lens", FEATURE_THIN_LENS, 13)              \
    X("orthographic", FEATURE_ORTHOGRAPHIC, 14)        \
    X("standard-error", FEATURE_STANDARD_ERROR, 15)    \
    X("first-hit-layers", FEATURE_FIRST_HIT_LAYERS, 16) \
    X("light-sampling", FEATURE_LIGHT_SAMPLING, 17) \
    X("resampling", FEATURE_RESAMPLING, 18)            \
    X("motion", FEATURE_MOTION, 19) \
    X("later-vertices", FEATURE_LATER_VERTICES, 20) \
    X("target-visibility", FEATURE_TARGET_VISIBILITY, 21) \
    X("microfacet-normal-maps", FEATURE_MICROFACET_NORMAL_MAPS, 22) \
    X("light-tree", FEATURE_LIGHT_TREE, 23)

SHARED_BEGIN
#define DECLARE_FEATURE(name, constant, bit) CONST uint constant = 1u << bit;
FEATURE_LIST(DECLARE_FEATURE)
#undef DECLARE_FEATURE
SHARED_END

#endif
