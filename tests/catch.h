// Catch2 2 or 3 under one name, and a way to say that a test could not run here.
#pragma once

#include <string>

#if DIPTYCH_CATCH_VERSION >= 3
#include <catch2/catch_all.hpp>
using Catch::Approx;
namespace Catch {
inline auto Contains(const std::string& text) {
    return Matchers::ContainsSubstring(text);
}
}  // namespace Catch
#else
#include <catch2/catch.hpp>
#endif

namespace diptych::core::tests {

/// Prints "SKIPPED: reason". A program of which every test case was skipped ends with code 77, which CTest counts as
/// skipped (skipping.h).
void report_skipped(const std::string& reason);

}  // namespace diptych::core::tests

/// Leaves the test case, whose needs this machine does not meet. Stands before every assertion: skipped means not run.
#define SKIP_TEST(reason)                                                                                              \
    do {                                                                                                               \
        diptych::core::tests::report_skipped(reason);                                                                  \
        return;                                                                                                        \
    } while (false)
