// Values of a render request as text, exact to the bit: "x,y,z".
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

#include "render/request.h"

namespace diptych::core {

inline std::string triple(double x, double y, double z) {
    return fmt::format("{},{},{}", x, y, z);
}

/// Empty where there is no value.
inline std::string triple(const std::optional<glm::dvec3>& v) {
    return v ? triple(v->x, v->y, v->z) : "";
}

/// Azimuth, elevation and irradiance; empty where there is no sun.
inline std::string sun_text(const std::optional<Sun>& sun) {
    return sun ? triple(sun->azimuth, sun->elevation, sun->irradiance) : "";
}

}  // namespace diptych::core
