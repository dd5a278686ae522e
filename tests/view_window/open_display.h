// What tests of the window begin and end with.
#pragma once

#include <string>

#include "catch.h"
#include "driven_view.h"

namespace diptych::tests {

inline bool is_settled(const Event& event) {
    return event["divisor"] == 1 && event["spp"] >= 2;
}

/// The validation layer, or a device, may be missing where Xvfb is not.
inline bool can_open(const VirtualDisplay& display, const TemporaryFolder& folder, const std::string& scene,
                     std::string& reason) {
    const ProcessResult result = run_diptych(folder, {"render", scene, "-o", folder.file("probe.exr"), "--spp", "1",
                                                      "--size", "4", "--backend", "vulkan", "--validation"});
    reason = display.name().empty() ? "Xvfb does not start" : result.err;
    return !display.name().empty() && result.exit_code == 0;
}

inline void check_clean(const ProcessResult& result) {
    INFO(result.err);
    CHECK(result.exit_code == 0);
    CHECK(result.err.find("validation:") == std::string::npos);
    CHECK(result.err.find("XDG_RUNTIME_DIR") == std::string::npos);  // libwayland's, on a display of X11
}

#define OPEN_DISPLAY(display, folder, scene)                                                                           \
    if (!has_virtual_display()) {                                                                                      \
        SKIP_TEST("Xvfb or xdotool is not installed");                                                                 \
    }                                                                                                                  \
    const VirtualDisplay display(640, 400);                                                                            \
    const TemporaryFolder folder;                                                                                      \
    const std::string scene = generate_scene(folder, "cornell");                                                       \
    if (std::string reason; !can_open(display, folder, scene, reason)) {                                               \
        SKIP_TEST("no window with a validated Vulkan device here: " + reason);                                         \
    }

}  // namespace diptych::tests
