#include "extremes.h"

TEST_CASE("Extremes: roulette") {
    diptych::tests::check_row("roulette");
}

TEST_CASE("Extremes in full: roulette", "[nightly]") {
    diptych::tests::check_row_in_full("roulette");
}
