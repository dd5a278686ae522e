#include "extremes.h"

TEST_CASE("Extremes: Blinn-Phong") {
    diptych::core::tests::check_row("Blinn-Phong");
}

TEST_CASE("Extremes in full: Blinn-Phong", "[nightly]") {
    diptych::core::tests::check_row_in_full("Blinn-Phong");
}
