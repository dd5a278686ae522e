#include "extremes.h"

TEST_CASE("Extremes: shading normals") {
    diptych::core::tests::check_row("shading normals");
}

TEST_CASE("Extremes in full: shading normals", "[nightly]") {
    diptych::core::tests::check_row_in_full("shading normals");
}
