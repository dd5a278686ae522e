// What tests of the window begin and end with.
#pragma once

#include <string>

#include "catch.h"
#include "driven_view.h"

namespace diptych::core::tests {

inline bool is_settled(const Event& event) {
    return event["divisor"] == 1 && event["spp"] >= 2;
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
    if (display.name().empty()) {                                                                                      \
        SKIP_TEST("Xvfb does not start");                                                                              \
    }                                                                                                                  \
    NEED_PROGRAM_WITH_VULKAN();                                                                                        \
    const TemporaryFolder folder;                                                                                      \
    const std::string scene = generate_scene(folder, "cornell");

}  // namespace diptych::core::tests
