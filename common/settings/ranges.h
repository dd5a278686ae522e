// The settings that are numbers, each with one name and one range. The command line checks by this table, the view's
// sliders are made of it, and a picture's metadata use its names.
#pragma once

#include <array>
#include <limits>
#include <string>

namespace diptych::core {

struct NumberRange {
    double least;
    double most;

    constexpr bool holds(double value) const { return value >= least && value <= most; }  // not NaN
};

enum class SliderScale { linear, logarithmic };

struct SettingRange {
    const char* name;      // words between dashes
    NumberRange accepted;  // by every renderer
    NumberRange slider;    // the part that a slider spans; a typed number may be any that is accepted
    SliderScale scale = SliderScale::linear;
    const char* list = nullptr;  // option of several numbers, of which this is one; else the name is the option

    constexpr const char* option() const { return list != nullptr ? list : name; }
};

namespace ranges {

// What is kept in single precision has these ends.
inline constexpr double unlimited = std::numeric_limits<float>::max();
inline constexpr double positive = std::numeric_limits<float>::min();
// Where the scene's size decides what a slider spans.
inline constexpr NumberRange by_scene{0, 0};

inline constexpr SettingRange max_depth{"max-depth", {0, 65535}, {0, 65535}, SliderScale::logarithmic};
inline constexpr SettingRange candidates{"candidates", {1, 1024}, {1, 1024}, SliderScale::logarithmic};
inline constexpr SettingRange near_share{"near-share", {0, 1}, {0, 1}};
inline constexpr SettingRange spatial_passes{"spatial-passes", {0, 8}, {0, 8}};
inline constexpr SettingRange neighbors{"neighbors", {1, 8}, {1, 8}};
inline constexpr SettingRange reuse_radius{"reuse-radius", {positive, unlimited}, {1, 64}};
inline constexpr SettingRange confidence_cap{"confidence-cap", {positive, unlimited}, {1, 100}};
inline constexpr SettingRange env_scale{"env-scale", {0, unlimited}, {0, 100}, SliderScale::logarithmic};
inline constexpr SettingRange env_rotate{"env-rotate", {-unlimited, unlimited}, {-180, 180}};
inline constexpr SettingRange sun_azimuth{"sun-azimuth", {-unlimited, unlimited}, {0, 360}, SliderScale::linear, "sun"};
inline constexpr SettingRange sun_elevation{"sun-elevation", {-90, 90}, {-90, 90}, SliderScale::linear, "sun"};
inline constexpr SettingRange sun_irradiance{
    "sun-irradiance", {0, unlimited}, {0, 1000}, SliderScale::logarithmic, "sun"};
inline constexpr SettingRange fov{"fov", {0.001, 179}, {1, 179}};
inline constexpr SettingRange view_height{"view-height", {positive, unlimited}, by_scene, SliderScale::logarithmic};
inline constexpr SettingRange aperture{"aperture", {0, unlimited}, by_scene, SliderScale::logarithmic};
inline constexpr SettingRange focus{"focus", {positive, unlimited}, by_scene, SliderScale::logarithmic};
inline constexpr SettingRange exposure{"exposure", {-100, 100}, {-10, 10}};

inline constexpr std::array all{max_depth,     candidates,     near_share, spatial_passes, neighbors,
                                reuse_radius,  confidence_cap, env_scale,  env_rotate,     sun_azimuth,
                                sun_elevation, sun_irradiance, fov,        view_height,    aperture,
                                focus,         exposure};

}  // namespace ranges

/// What a typed number becomes: the accepted one that is nearest, or `before` where it is no number.
double nearest_accepted(const SettingRange& setting, double typed, double before);

/// "max_depth": the name of a setting in metadata and JSON.
std::string key_of(const std::string& setting);

/// "Max depth", "Reuse MIS": the name of a setting in an interface.
std::string label_of(const std::string& setting);

}  // namespace diptych::core
