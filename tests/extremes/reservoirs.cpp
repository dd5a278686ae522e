#include "extremes.h"

TEST_CASE("Extremes: reservoirs") {
    diptych::core::tests::check_row("reservoirs");
}

TEST_CASE("Extremes in full: reservoirs", "[nightly]") {
    diptych::core::tests::check_row_in_full("reservoirs");
}
