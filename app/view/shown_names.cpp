#include "view/shown_names.h"

#include <array>

#include "error.h"

namespace diptych::core::app {

namespace {

constexpr std::array shown_names = {"vulkan", "cpu", "split", "difference"};
constexpr std::array layers = {"radiance", "albedo",   "normal",      "depth",       "standard-error",
                               "samples",  "light-id", "reservoir-m", "reservoir-w", "nonfinite"};

}  // namespace

const char* name_of(ShownPanel panel) {
    return shown_names[static_cast<std::size_t>(panel)];
}

const char* name_of(ShownLayer layer) {
    return layers[static_cast<std::size_t>(layer)];
}

ShownPanel shown_panel_from_name(const std::string& name) {
    for (std::size_t i = 0; i < shown_names.size(); ++i) {
        if (name == shown_names[i]) {
            return static_cast<ShownPanel>(i);
        }
    }
    throw Error("--panel " + name + ": there are only vulkan, cpu, split, difference");
}

}  // namespace diptych::core::app
