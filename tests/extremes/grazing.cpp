#include "extremes.h"

TEST_CASE("Extremes: grazing") {
    diptych::tests::check_row("grazing");
}

TEST_CASE("Extremes in full: grazing", "[nightly]") {
    diptych::tests::check_row_in_full("grazing");
}
