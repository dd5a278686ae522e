// The chains of tests/restir on the device.
#include "../restir/moving_cases.h"
#include "panels_fixture.h"

namespace diptych::core::tests {
namespace {

std::unique_ptr<Renderer> on_vulkan(const PackedScene& packed) {
    return make_vulkan_renderer(panels_gpu(), packed);
}

}  // namespace

TEST_CASE("restir is unbiased where an occluder moves and then stops, on the device") {
    NEED_VULKAN();
    check_frames(coming_and_going_case(), coming_and_going_frames, 5, {}, on_vulkan);
}

TEST_CASE("Long chains of restir stay unbiased on the device", "[nightly]") {
    NEED_VULKAN();
    const ChainSize many{16, 64};
    for (const ResamplingVisibility visibility : {ResamplingVisibility::shading, ResamplingVisibility::target}) {
        std::vector<ChainCase> cases = moving_cases();
        cases.push_back(chain_case("many lights", generated("many-lights", 300)));
        cases.push_back(chain_case("slats", slats(false)));
        cases.push_back(chain_case("cornell", generated("cornell")));
        for (ChainCase& c : cases) {
            c.settings.resampling.visibility = visibility;
            check_frames(c, chain_frames, 2, many, on_vulkan);
        }
    }
}

}  // namespace diptych::core::tests
