#include "extremes.h"

TEST_CASE("Extremes: frames") {
    diptych::tests::check_row("frames");
}

TEST_CASE("Extremes in full: frames", "[nightly]") {
    diptych::tests::check_row_in_full("frames");
}
