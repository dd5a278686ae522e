#include "extremes.h"

TEST_CASE("Extremes: shadow epsilon") {
    diptych::tests::check_row("shadow epsilon");
}

TEST_CASE("Extremes in full: shadow epsilon", "[nightly]") {
    diptych::tests::check_row_in_full("shadow epsilon");
}
