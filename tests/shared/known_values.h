// Directions, colours and functions that many tests of the shared headers use.
#pragma once

#include "numbers/elementary.h"

namespace diptych::core::tests {

inline const shared::vec3 up(0.0F, 0.0F, 1.0F);
inline const shared::vec3 white(1.0F, 1.0F, 1.0F);

inline float sine(float x) {
    float s, c;
    shared::sin_cos(x, s, c);
    return s;
}

inline float cosine(float x) {
    float s, c;
    shared::sin_cos(x, s, c);
    return c;
}

}  // namespace diptych::core::tests
