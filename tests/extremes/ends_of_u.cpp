#include "extremes.h"

TEST_CASE("Extremes: ends of u") {
    diptych::core::tests::check_row("ends of u");
}

TEST_CASE("Extremes in full: ends of u", "[nightly]") {
    diptych::core::tests::check_row_in_full("ends of u");
}
