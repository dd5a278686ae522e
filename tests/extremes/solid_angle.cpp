#include "extremes.h"

TEST_CASE("Extremes: solid angle") {
    diptych::core::tests::check_row("solid angle");
}

TEST_CASE("Extremes in full: solid angle", "[nightly]") {
    diptych::core::tests::check_row_in_full("solid angle");
}
