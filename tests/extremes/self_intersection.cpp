#include "extremes.h"

TEST_CASE("Extremes: self-intersection") {
    diptych::core::tests::check_row("self-intersection");
}

TEST_CASE("Extremes in full: self-intersection", "[nightly]") {
    diptych::core::tests::check_row_in_full("self-intersection");
}
