// What could not run here. Tests say so by SKIP_TEST (catch.h).
#pragma once

namespace diptych::tests {

/// Whether report_skipped has been called.
bool any_skipped();

}  // namespace diptych::tests
