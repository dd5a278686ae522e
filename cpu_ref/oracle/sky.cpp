#include "oracle/sky.h"

#include <algorithm>
#include <cmath>

#include "oracle/bsdf.h"
#include "oracle/random.h"
#include "oracle/world.h"

namespace diptych::core::oracle {

namespace {

/// Where the map shows what lies in this direction, (u, v). The map turns by the rotation, so that is looked up turned
/// back.
dvec2 map_point(const Environment& environment, const dvec3& direction) {
    const double c = std::cos(environment.rotation);
    const double s = std::sin(environment.rotation);
    const double x = direction.x * c - direction.z * s;
    const double z = direction.x * s + direction.z * c;
    return {0.5 + std::atan2(x, -z) / (2 * pi), std::acos(glm::clamp(direction.y, -1.0, 1.0)) / pi};
}

dvec3 map_direction(const Environment& environment, const dvec2& point) {
    const double angle = 2 * pi * (point.x - 0.5);
    const double sine = std::sin(pi * point.y);
    const double x = sine * std::sin(angle);
    const double z = -sine * std::cos(angle);
    const double c = std::cos(environment.rotation);
    const double s = std::sin(environment.rotation);
    return normalize(dvec3(x * c + z * s, std::cos(pi * point.y), z * c - x * s));
}

dvec3 texel(const Environment& environment, int x, int y) {
    return dvec3(environment.texels[std::size_t(y) * std::size_t(environment.width) + std::size_t(x)]);
}

/// Between the texel centres around the point, of texel(column, row): wrapped in u, held in v.
template <typename Texel>
auto filtered(const Environment& environment, const dvec2& point, Texel at) {
    const double across = point.x * environment.width - 0.5;
    const double down = point.y * environment.height - 0.5;
    const double fx = across - std::floor(across);
    const double fy = down - std::floor(down);
    const int left = (int(std::floor(across)) + environment.width) % environment.width;
    const int right = (left + 1) % environment.width;
    const int top = glm::clamp(int(std::floor(down)), 0, environment.height - 1);
    const int bottom = glm::clamp(int(std::floor(down)) + 1, 0, environment.height - 1);
    return bilinear(at(left, top), at(right, top), at(left, bottom), at(right, bottom), fx, fy);
}

double texel_weight(const Environment& environment, int x, int y) {
    const dvec3 radiance = texel(environment, x, y) * dvec3(environment.scale);
    return (radiance.x + radiance.y + radiance.z) * std::sin(pi * (y + 0.5) / environment.height);
}

}  // namespace

dvec3 environment_radiance(const Environment& environment, const dvec3& direction) {
    if (environment.kind == EnvironmentKind::none) {
        return dvec3(0);
    }
    if (environment.kind == EnvironmentKind::constant) {
        return dvec3(environment.scale);
    }
    const auto at = [&](int x, int y) { return texel(environment, x, y); };
    return filtered(environment, map_point(environment, direction), at) * dvec3(environment.scale);
}

SkyMap::SkyMap(const Environment& environment) : environment_(environment) {
    if (environment.kind != EnvironmentKind::map) {
        return;
    }
    double sum = 0;
    for (int y = 0; y < environment.height; ++y) {
        for (int x = 0; x < environment.width; ++x) {
            weight_up_to_.push_back(sum += texel_weight(environment, x, y));
        }
    }
    if (!(sum > 0)) {
        weight_up_to_.clear();
    }
}

SkyMap::Direction SkyMap::sample(Random& random) const {
    const double place = random.uniform() * weight_up_to_.back();
    const auto found = std::upper_bound(weight_up_to_.begin(), weight_up_to_.end(), place);
    const auto index =
        int(std::min<std::ptrdiff_t>(found - weight_up_to_.begin(), std::ptrdiff_t(weight_up_to_.size()) - 1));
    const double across = index % environment_.width + 0.5 + random.uniform() - random.uniform();
    // What the tent has beyond a pole comes back: so held texels add up as they do in the radiance.
    double down = std::abs(double(index / environment_.width) + 0.5 + random.uniform() - random.uniform());
    down = down > environment_.height ? 2 * environment_.height - down : down;
    const dvec3 direction = map_direction(environment_, {across / environment_.width, down / environment_.height});
    return {direction, density(direction)};
}

double SkyMap::density(const dvec3& direction) const {
    if (empty()) {
        return 0;
    }
    const auto weight = [&](int x, int y) { return texel_weight(environment_, x, y); };
    const double there = filtered(environment_, map_point(environment_, direction), weight);
    const double sine = std::sqrt(glm::max(1 - direction.y * direction.y, 1e-300));
    return there * double(weight_up_to_.size()) / (weight_up_to_.back() * 2 * pi * pi * sine);
}

}  // namespace diptych::core::oracle
