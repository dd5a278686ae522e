#include "extremes.h"

TEST_CASE("Extremes: grazing") {
    diptych::core::tests::check_row("grazing");
}

TEST_CASE("Extremes in full: grazing", "[nightly]") {
    diptych::core::tests::check_row_in_full("grazing");
}
