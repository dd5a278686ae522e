#include "extremes.h"

TEST_CASE("Extremes: flattened transforms") {
    diptych::core::tests::check_row("flattened transforms");
}

TEST_CASE("Extremes in full: flattened transforms", "[nightly]") {
    diptych::core::tests::check_row_in_full("flattened transforms");
}
