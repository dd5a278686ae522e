#include "extremes.h"

TEST_CASE("Extremes: light range") {
    diptych::core::tests::check_row("light range");
}

TEST_CASE("Extremes in full: light range", "[nightly]") {
    diptych::core::tests::check_row_in_full("light range");
}
