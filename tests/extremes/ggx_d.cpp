#include "extremes.h"

TEST_CASE("Extremes: GGX D") {
    diptych::core::tests::check_row("GGX D");
}

TEST_CASE("Extremes in full: GGX D", "[nightly]") {
    diptych::core::tests::check_row_in_full("GGX D");
}
