#include "scene/sun.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace diptych::core {

PunctualLight sun_light(const Sun& sun) {
    const double azimuth = glm::radians(sun.azimuth);
    const double elevation = glm::radians(sun.elevation);
    const glm::dvec3 east(std::cos(azimuth), 0, std::sin(azimuth));
    const glm::dvec3 toward(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                            -std::cos(azimuth) * std::cos(elevation));
    PunctualLight light;
    light.name = "(sun)";
    light.type = PunctualType::directional;
    light.light_to_world[0] = glm::dvec4(east, 0);
    light.light_to_world[1] = glm::dvec4(glm::cross(toward, east), 0);
    light.light_to_world[2] = glm::dvec4(toward, 0);
    light.intensity = glm::vec3(static_cast<float>(sun.irradiance));
    return light;
}

}  // namespace diptych::core
