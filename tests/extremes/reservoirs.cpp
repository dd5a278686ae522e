#include "extremes.h"

TEST_CASE("Extremes: reservoirs") {
    diptych::tests::check_row("reservoirs");
}

TEST_CASE("Extremes in full: reservoirs", "[nightly]") {
    diptych::tests::check_row_in_full("reservoirs");
}
