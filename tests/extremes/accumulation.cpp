#include "extremes.h"

TEST_CASE("Extremes: accumulation") {
    diptych::tests::check_row("accumulation");
}

TEST_CASE("Extremes in full: accumulation", "[nightly]") {
    diptych::tests::check_row_in_full("accumulation");
}
