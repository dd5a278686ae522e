#include "extremes.h"

TEST_CASE("Extremes: ends of u") {
    diptych::tests::check_row("ends of u");
}

TEST_CASE("Extremes in full: ends of u", "[nightly]") {
    diptych::tests::check_row_in_full("ends of u");
}
