#include "extremes.h"

TEST_CASE("Extremes: watertightness") {
    diptych::core::tests::check_row("watertightness");
}

TEST_CASE("Extremes in full: watertightness", "[nightly]") {
    diptych::core::tests::check_row_in_full("watertightness");
}
