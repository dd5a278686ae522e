#include "console/option_names.h"

#include <algorithm>

namespace diptych::core::app {

namespace {

constexpr OptionName names[] = {
    {"allow_external", "--allow-external"},
    {"atlas", "--atlas"},
    {"backend", "--backend"},
    {"brdf", "--brdf"},
    {"clip", "--clip"},
    {"count", "--count"},
    {"eye", "--eye"},
    {"fov", "--fov"},
    {"ignored_extensions", "--ignore-extension"},
    {"integrator", "--integrator"},
    {"layers", "--layers"},
    {"light_sampler", "--light-sampler"},
    {"look_at", "--look-at"},
    {"memory_limit", "--memory-limit"},
    {"methods", "--methods"},
    {"mis", "--mis"},
    {"normal_maps", "--normal-maps"},
    {"oracle_mode", "--oracle-mode"},
    {"output", "-o"},
    {"reference", "--reference"},
    {"reuse_mis", "--reuse-mis"},
    {"reuse_visibility", "--reuse-visibility"},
    {"resume", "--resume"},
    {"sampler", "--sampler"},
    {"samples", "--samples"},
    {"size", "--size"},
    {"sums", "--sums"},
    {"up", "--up"},
    {"view_height", "--view-height"},
};

}  // namespace

std::span<const OptionName> option_names() {
    return names;
}

std::string with_option_names(const std::string& message) {
    std::string out;
    std::size_t at = 0;
    while (at < message.size()) {
        const std::size_t open = message.find('`', at);
        const std::size_t close = open == std::string::npos ? open : message.find('`', open + 1);
        if (close == std::string::npos) {
            break;
        }
        out += message.substr(at, open - at);
        const std::string word = message.substr(open + 1, close - open - 1);
        const auto* known = std::find_if(std::begin(names), std::end(names),
                                         [&](const OptionName& name) { return name.setting == word; });
        if (known != std::end(names)) {
            out += known->option;
            at = close + 1;
        } else {  // other text: its closing backtick may open a name
            out += message.substr(open, close - open);
            at = close;
        }
    }
    return out + message.substr(at);
}

}  // namespace diptych::core::app
