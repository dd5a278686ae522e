#include "extremes.h"

TEST_CASE("Extremes: huge coordinates") {
    diptych::tests::check_row("huge coordinates");
}

TEST_CASE("Extremes in full: huge coordinates", "[nightly]") {
    diptych::tests::check_row_in_full("huge coordinates");
}
