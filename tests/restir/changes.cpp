// ReSTIR where the frame before had other lights or other occluders, and at the frames after, when nothing changes any
// more.
#include "moving_cases.h"

namespace diptych::core::tests {

TEST_CASE("restir is unbiased over punctual lights of every kind that switch and move") {
    const std::pair<PunctualType, const char*> kinds[] = {
        {PunctualType::point, "point"}, {PunctualType::spot, "spot"}, {PunctualType::directional, "directional"}};
    for (const auto& [type, name] : kinds) {
        for (const Change change : {Change::switches, Change::moves}) {
            const char* what = change == Change::switches ? " light switches" : " light moves";
            check_frames(stepped_case(std::string(name) + what, punctual_corner(type, change)), {0, 1, 2, 3, 5, 6}, 5);
        }
    }
}

TEST_CASE("restir is unbiased where an occluder moves and then stops, with visibility in the target") {
    check_frames(coming_and_going_case(), coming_and_going_frames, 5);
}

}  // namespace diptych::core::tests
