#include "extremes.h"

TEST_CASE("Extremes: VNDF") {
    diptych::core::tests::check_row("VNDF");
}

TEST_CASE("Extremes in full: VNDF", "[nightly]") {
    diptych::core::tests::check_row_in_full("VNDF");
}
