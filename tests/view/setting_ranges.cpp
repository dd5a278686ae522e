// The table of settings: what the sliders offer, the command line takes, and no more.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>

#include "commands/arguments/arguments.h"
#include "catch.h"
#include "console/repeat_command.h"
#include "settings/ranges.h"
#include "view/view_state.h"

using namespace diptych::core;
using namespace diptych::core::app;

namespace {

/// Whether the options that `render`, `view` and the others share take this value of the setting.
bool command_line_takes(const SettingRange& setting, const std::string& value) {
    CLI::App app;
    RenderArguments arguments;
    std::string tonemap;
    add_scene_options(app, arguments);
    add_display_options(app, arguments.request.exposure, tonemap, "");
    const std::string name = setting.name;
    // Three settings are one option.
    const std::map<std::string, std::string> of_sun{
        {"sun-azimuth", "--sun={},0,0"}, {"sun-elevation", "--sun=0,{},0"}, {"sun-irradiance", "--sun=0,0,{}"}};
    const auto sun = of_sun.find(name);
    const std::string option = sun == of_sun.end() ? "--" + name + "={}" : sun->second;
    try {
        std::vector<std::string> words{fmt::format(fmt::runtime(option), value)};
        app.parse(words);
        return true;
    } catch (const std::exception&) {
        return false;
    }
}

bool is_count(const SettingRange& setting) {
    static const std::set<std::string> counts{"max-depth", "candidates", "spatial-passes", "neighbors"};
    return counts.count(setting.name) > 0;
}

std::string text_of(const SettingRange& setting, double value) {
    return is_count(setting) ? fmt::format("{}", static_cast<long long>(value)) : fmt::format("{}", value);
}

}  // namespace

TEST_CASE("the command line takes both ends of each slider, and refuses one step beyond what is accepted", "[ranges]") {
    for (const SettingRange& setting : ranges::all) {
        INFO(setting.name);
        const auto [least, most] = setting.accepted;
        CHECK(command_line_takes(setting, text_of(setting, least)));
        CHECK(command_line_takes(setting, text_of(setting, most)));
        if (setting.slider.least < setting.slider.most) {
            CHECK(command_line_takes(setting, text_of(setting, setting.slider.least)));
            CHECK(command_line_takes(setting, text_of(setting, setting.slider.most)));
            CHECK(setting.accepted.holds(setting.slider.least));
            CHECK(setting.accepted.holds(setting.slider.most));
        }
        const auto beyond = [&](double end, double away) {
            return text_of(setting, is_count(setting) ? end + std::copysign(1, away) : std::nextafter(end, away));
        };
        if (most < ranges::unlimited) {
            CHECK_FALSE(command_line_takes(setting, beyond(most, 1e9)));
        }
        if (least > -ranges::unlimited) {
            CHECK_FALSE(command_line_takes(setting, beyond(std::abs(least) <= ranges::positive ? 0 : least, -1e9)));
        }
        CHECK_FALSE(command_line_takes(setting, "nan"));
        CHECK_FALSE(command_line_takes(setting, "inf"));
        CHECK_FALSE(command_line_takes(setting, "-inf"));
    }
    CHECK_FALSE(command_line_takes(ranges::reuse_radius, "0"));
    CHECK_FALSE(command_line_takes(ranges::candidates, "0"));
    CHECK_FALSE(command_line_takes(ranges::neighbors, "9"));
}

TEST_CASE("a number typed into a slider becomes one that is accepted", "[ranges]") {
    for (const SettingRange& setting : ranges::all) {
        INFO(setting.name);
        for (const double typed : {-1e300, -1.0, 0.0, 1e-300, 0.5, 9.0, 1e6, 1e300, HUGE_VAL, -HUGE_VAL}) {
            const double value = nearest_accepted(setting, typed, 1);
            CHECK(setting.accepted.holds(value));
            CHECK((value == typed || !setting.accepted.holds(typed)));
        }
        CHECK(nearest_accepted(setting, NAN, 1) == 1);
    }
    CHECK(nearest_accepted(ranges::neighbors, 16, 4) == 8);
    CHECK(nearest_accepted(ranges::candidates, 0, 4) == 1);
}

TEST_CASE("defaults lie within what sliders span", "[ranges]") {
    const RenderRequest request;
    const ResamplingSettings& resampling = request.settings.resampling;
    CHECK(ranges::max_depth.slider.holds(request.settings.max_depth));
    CHECK(ranges::candidates.slider.holds(resampling.light_candidates));
    CHECK(ranges::near_share.slider.holds(resampling.near_share));
    CHECK(ranges::spatial_passes.slider.holds(resampling.spatial_passes));
    CHECK(ranges::neighbors.slider.holds(resampling.neighbors));
    CHECK(ranges::reuse_radius.slider.holds(resampling.radius));
    CHECK(ranges::confidence_cap.slider.holds(resampling.confidence_cap));
    CHECK(ranges::env_scale.slider.holds(request.environment_scale));
    CHECK(ranges::env_rotate.slider.holds(request.environment_rotation));
    CHECK(ranges::sun_azimuth.slider.holds(Sun{}.azimuth));
    CHECK(ranges::sun_elevation.slider.holds(Sun{}.elevation));
    CHECK(ranges::sun_irradiance.slider.holds(Sun{}.irradiance));
    CHECK(ranges::exposure.slider.holds(request.exposure));
}

TEST_CASE("a setting has one name in options, labels and metadata", "[ranges]") {
    CHECK(option_of(ranges::max_depth) == "--max-depth");
    CHECK(label_of("max-depth") == "Max depth");
    CHECK(label_of("reuse-mis") == "Reuse MIS");
    CHECK(label_of("bsdf-candidate") == "BSDF candidate");
    CHECK(label_of("fov") == "FOV");
    CHECK(key_of("env-scale") == "env_scale");
    RenderRequest request;
    request.settings.integrator = Integrator::restir;
    const auto metadata = render_metadata(request, {});
    const std::string command = app::repeat_command(request, 1);
    for (const SettingRange& setting : ranges::all) {
        INFO(setting.name);
        const bool of_sun = std::string(setting.name).rfind("sun-", 0) == 0;
        CHECK(metadata.count(of_sun ? "sun" : key_of(setting.name)) == 1);
    }
    for (const char* name : {"reuse-mis", "reuse-visibility", "near-share", "candidates", "neighbors", "max-depth"}) {
        CHECK(command.find(fmt::format(" --{} ", name)) != std::string::npos);
        CHECK(metadata.count(key_of(name)) == 1);
    }
    CHECK(metadata.at("neighbors") == "4");
}

TEST_CASE("a picture and a view have one default tone map", "[ranges]") {
    CHECK(RenderRequest{}.tonemap == tonemap_name(default_tonemap));
    CHECK(ShownState{}.tonemap == default_tonemap);
}
