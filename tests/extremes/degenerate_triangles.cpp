#include "extremes.h"

TEST_CASE("Extremes: degenerate triangles") {
    diptych::core::tests::check_row("degenerate triangles");
}

TEST_CASE("Extremes in full: degenerate triangles", "[nightly]") {
    diptych::core::tests::check_row_in_full("degenerate triangles");
}
