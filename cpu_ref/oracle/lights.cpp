#include "oracle/lights.h"

#include <algorithm>
#include <cmath>

#include "oracle/bsdf.h"
#include "oracle/surface.h"

namespace diptych::oracle {

namespace {

double spot_factor(const PunctualLight& light, double cosine) {
    const double range = glm::max(0.001, std::cos(light.inner_cone) - std::cos(light.outer_cone));
    const double x = glm::clamp((cosine - std::cos(light.outer_cone)) / range, 0.0, 1.0);
    return x * x;
}

dvec3 texel(const Environment& environment, int x, int y) {
    const int column = (x + environment.width) % environment.width;
    const int row = glm::clamp(y, 0, environment.height - 1);
    return dvec3(environment.texels[std::size_t(row) * std::size_t(environment.width) + std::size_t(column)]);
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

dvec3 environment_radiance(const Environment& environment, const dvec3& direction) {
    if (environment.kind == EnvironmentKind::none) {
        return dvec3(0);
    }
    if (environment.kind == EnvironmentKind::constant) {
        return dvec3(environment.scale);
    }
    // The map turns by the rotation, so what it shows is looked up turned back.
    const double c = std::cos(environment.rotation);
    const double s = std::sin(environment.rotation);
    const double x = direction.x * c - direction.z * s;
    const double z = direction.x * s + direction.z * c;
    const double u = 0.5 + std::atan2(x, -z) / (2 * pi);
    const double v = std::acos(glm::clamp(direction.y, -1.0, 1.0)) / pi;
    const double across = u * environment.width - 0.5;
    const double down = v * environment.height - 0.5;
    const int column = int(std::floor(across));
    const int row = int(std::floor(down));
    const double fx = across - column;
    const double fy = down - row;
    const dvec3 upper = texel(environment, column, row) * (1 - fx) + texel(environment, column + 1, row) * fx;
    const dvec3 lower = texel(environment, column, row + 1) * (1 - fx) + texel(environment, column + 1, row + 1) * fx;
    return (upper * (1 - fy) + lower * fy) * dvec3(environment.scale);
}

Emitters::Emitters(const World& world) {
    double sum = 0;
    for (std::size_t i = 0; i < world.triangles.size(); ++i) {
        if (emits(*world.triangles[i].material)) {
            triangles_.push_back(i);
            area_up_to_.push_back(sum += area(world.triangles[i]));
        }
    }
}

Emitters::Point Emitters::sample(Random& random) const {
    const double place = random.uniform() * total_area();
    const auto found = std::upper_bound(area_up_to_.begin(), area_up_to_.end(), place);
    const auto index = std::min<std::size_t>(std::size_t(found - area_up_to_.begin()), triangles_.size() - 1);
    const double root = std::sqrt(random.uniform());
    const double share = random.uniform();
    return {triangles_[index], dvec2(root * (1 - share), root * share)};
}

}  // namespace diptych::oracle
