#include "extremes.h"

TEST_CASE("Extremes: self-intersection") {
    diptych::tests::check_row("self-intersection");
}

TEST_CASE("Extremes in full: self-intersection", "[nightly]") {
    diptych::tests::check_row_in_full("self-intersection");
}
