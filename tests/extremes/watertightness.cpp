#include "extremes.h"

TEST_CASE("Extremes: watertightness") {
    diptych::tests::check_row("watertightness");
}

TEST_CASE("Extremes in full: watertightness", "[nightly]") {
    diptych::tests::check_row_in_full("watertightness");
}
