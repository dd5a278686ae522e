// The compatibility header of both languages, and the only file with macros that depend on the language. The dialect
// is GLSL's. C++ imports its names from GLM one by one, so that the list below is the whole vocabulary and the C++
// compiler acts as the linter.
#ifndef COMPAT_H
#define COMPAT_H

#if defined(__cplusplus)

#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#define FN inline
#define CONST inline constexpr
#define IN(T) const T&
#define OUT(T) T&
#define INOUT(T) T&
#define LOCAL(T) const T&
#define PRECISE
#define SHARED_BEGIN namespace diptych::core::shared {
#define SHARED_END }
#define ASSERT_SIZE(T, bytes) static_assert(sizeof(T) == (bytes))
#define ASSERT_OFFSET(T, field, bytes) static_assert(offsetof(T, field) == (bytes))

namespace diptych::core::shared {
using glm::bvec3;
using glm::clamp;
using glm::cross;
using glm::dot;
using glm::floor;
using glm::inversesqrt;
using glm::length;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using glm::sign;
using glm::sqrt;
using glm::uint;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

// GLM's version compares and negates; the builtin is one instruction.
inline float abs(float x) { return __builtin_fabsf(x); }
inline vec3 abs(const vec3& v) { return vec3(abs(v.x), abs(v.y), abs(v.z)); }
inline uint floatBitsToUint(float x) { return std::bit_cast<uint>(x); }
inline float uintBitsToFloat(uint x) { return std::bit_cast<float>(x); }
inline int floatBitsToInt(float x) { return std::bit_cast<int>(x); }
inline float intBitsToFloat(int x) { return std::bit_cast<float>(x); }
/// High 32 bits of the 64-bit product.
inline uint multiply_high(uint a, uint b) { return static_cast<uint>((std::uint64_t{a} * b) >> 32U); }
inline uint bitfieldReverse(uint x) {
    x = __builtin_bswap32(x);
    x = ((x & 0x0f0f0f0fU) << 4U) | ((x >> 4U) & 0x0f0f0f0fU);
    x = ((x & 0x33333333U) << 2U) | ((x >> 2U) & 0x33333333U);
    return ((x & 0x55555555U) << 1U) | ((x >> 1U) & 0x55555555U);
}
inline vec3 xyz(const vec4& v) { return vec3(v); }
}  // namespace diptych::core::shared

#elif defined(VULKAN)

#define FN
#define CONST const
#define IN(T) in T
#define OUT(T) out T
#define INOUT(T) inout T
#define LOCAL(T) T
#define PRECISE precise
#define SHARED_BEGIN
#define SHARED_END
#define ASSERT_SIZE(T, bytes)
#define ASSERT_OFFSET(T, field, bytes)

uint multiply_high(uint a, uint b) {
    uint high;
    uint low;
    umulExtended(a, b, high, low);
    return high;
}
#include "language/ordered.glsl"

#else
#error "shared headers compile as C++ or as Vulkan GLSL"
#endif

// Mutation testing (tests/mutants): `right`, unless CMake's DIPTYCH_MUTANT selects this mutant; then `wrong`.
#if defined(DIPTYCH_MUTANT)
#include "mutant_switches.h"
#define MUTANT(name, right, wrong) (MUTANT_##name ? (wrong) : (right))
#else
#define MUTANT(name, right, wrong) (right)
#endif

SHARED_BEGIN
CONST uint NONE = 0xffffffffu;  // index that means "none"
CONST float PI = 3.14159265358979f;
CONST float INV_PI = 0.318309886183791f;
CONST float INFINITE_DISTANCE = 3.0e38f;
SHARED_END

#endif
