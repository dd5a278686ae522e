#include "extremes.h"

TEST_CASE("Extremes: VNDF") {
    diptych::tests::check_row("VNDF");
}

TEST_CASE("Extremes in full: VNDF", "[nightly]") {
    diptych::tests::check_row_in_full("VNDF");
}
