#include "extremes.h"

TEST_CASE("Extremes: shadow epsilon") {
    diptych::core::tests::check_row("shadow epsilon");
}

TEST_CASE("Extremes in full: shadow epsilon", "[nightly]") {
    diptych::core::tests::check_row_in_full("shadow epsilon");
}
