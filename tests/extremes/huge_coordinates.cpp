#include "extremes.h"

TEST_CASE("Extremes: huge coordinates") {
    diptych::core::tests::check_row("huge coordinates");
}

TEST_CASE("Extremes in full: huge coordinates", "[nightly]") {
    diptych::core::tests::check_row_in_full("huge coordinates");
}
