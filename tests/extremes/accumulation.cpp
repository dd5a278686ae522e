#include "extremes.h"

TEST_CASE("Extremes: accumulation") {
    diptych::core::tests::check_row("accumulation");
}

TEST_CASE("Extremes in full: accumulation", "[nightly]") {
    diptych::core::tests::check_row_in_full("accumulation");
}
