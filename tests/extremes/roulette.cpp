#include "extremes.h"

TEST_CASE("Extremes: roulette") {
    diptych::core::tests::check_row("roulette");
}

TEST_CASE("Extremes in full: roulette", "[nightly]") {
    diptych::core::tests::check_row_in_full("roulette");
}
