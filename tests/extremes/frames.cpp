#include "extremes.h"

TEST_CASE("Extremes: frames") {
    diptych::core::tests::check_row("frames");
}

TEST_CASE("Extremes in full: frames", "[nightly]") {
    diptych::core::tests::check_row_in_full("frames");
}
