// Whether a sanitizer instruments the tests and the program. It takes time and memory of its own.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DIPTYCH_SANITIZED true
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define DIPTYCH_SANITIZED true
#endif
#endif
#ifndef DIPTYCH_SANITIZED
#define DIPTYCH_SANITIZED false
#endif

namespace diptych::core::tests {

constexpr bool sanitized = DIPTYCH_SANITIZED;

}  // namespace diptych::core::tests
