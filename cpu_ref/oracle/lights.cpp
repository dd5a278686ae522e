#include "oracle/lights.h"

#include <cmath>
#include <limits>

namespace diptych::core::oracle {

namespace {

double spot_factor(const PunctualLight& light, double cosine) {
    const double range = glm::max(0.001, std::cos(light.inner_cone) - std::cos(light.outer_cone));
    const double x = glm::clamp((cosine - std::cos(light.outer_cone)) / range, 0.0, 1.0);
    return x * x;
}

}  // namespace

PunctualSample sample_punctual(const World& world, const PunctualLight& light, const dvec3& position) {
    const dvec3 axis = -normalize(dvec3(light.light_to_world[2]));
    const dvec3 intensity(light.intensity);
    if (light.type == PunctualType::directional) {
        return {-axis, std::numeric_limits<double>::infinity(), intensity};
    }
    const dvec3 to = dvec3(light.light_to_world[3]) - world.origin - position;
    const double distance = length(to);
    if (!(distance > 0)) {
        return {axis, 0, dvec3(0)};
    }
    const dvec3 direction = to / distance;
    const double factor = light.type == PunctualType::spot ? spot_factor(light, -dot(direction, axis)) : 1;
    return {direction, distance, intensity * (factor / (distance * distance))};
}

}  // namespace diptych::core::oracle
