#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pack/alias_table_build.h"
#include "pack/pack_parts.h"

namespace diptych::core {
namespace {

float largest(const glm::vec3& c) {
    return std::max({c.x, c.y, c.z});
}

/// Mean over one texel's area of what bilinear filtering makes of the map: the tent over the texel integrates to (1, 6,
/// 1)/8 each way. So a black texel beside a bright one keeps a probability.
double filtered_luminance(const Environment& e, const glm::vec3& tint, int x, int y) {
    constexpr std::array<double, 3> tent = {0.125, 0.75, 0.125};
    double sum = 0;
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            const int column = (x + i + e.width) % e.width;
            const int row = std::clamp(y + j, 0, e.height - 1);
            const auto texel =
                static_cast<std::size_t>(row) * static_cast<std::size_t>(e.width) + static_cast<std::size_t>(column);
            const double weight = tent[static_cast<std::size_t>(i + 1)] * tent[static_cast<std::size_t>(j + 1)];
            sum += weight * luminance(glm::dvec3(e.texels[texel]) * glm::dvec3(tint));
        }
    }
    return sum;
}

}  // namespace

void place_environment(const Scene& scene, PackedScene& packed) {
    const Environment& e = scene.environment;
    shared::Environment& out = packed.constants.environment;
    out.scale = e.scale;
    out.rotation = {static_cast<float>(std::cos(e.rotation)), static_cast<float>(std::sin(e.rotation))};
    packed.environment_luminance = packed.environment_mean * largest(e.scale);
}

glm::vec3 environment_tint(const Environment& environment) {
    const float scale = largest(environment.scale);
    return scale > 0 ? environment.scale / scale : glm::vec3(0);
}

void pack_environment(const Scene& scene, const RenderSettings& settings, PackedScene& packed) {
    const Environment& e = scene.environment;
    shared::Environment& out = packed.constants.environment;
    packed.environment_tint = environment_tint(e);
    if (e.kind == Environment::Kind::none) {
        out.kind = shared::ENVIRONMENT_NONE;
        place_environment(scene, packed);
        return;
    }
    if (e.kind == Environment::Kind::constant) {
        out.kind = shared::ENVIRONMENT_CONSTANT;
        packed.environment_mean = luminance(glm::dvec3(packed.environment_tint));
        place_environment(scene, packed);
        return;
    }
    out.kind = shared::ENVIRONMENT_MAP;
    out.size = {static_cast<std::uint32_t>(e.width), static_cast<std::uint32_t>(e.height)};
    std::vector<double> weights;
    weights.reserve(e.texels.size());
    double mean = 0;
    glm::dvec3 heading(0);
    for (int y = 0; y < e.height; ++y) {
        const double top = std::numbers::pi * y / e.height;
        const double bottom = std::numbers::pi * (y + 1) / e.height;
        const double solid_angle = 2 * std::numbers::pi / e.width * (std::cos(top) - std::cos(bottom));
        const double height = std::cos(0.5 * (top + bottom));
        const double sine = std::sin(0.5 * (top + bottom));
        for (int x = 0; x < e.width; ++x) {
            const double turn = 2 * std::numbers::pi * ((x + 0.5) / e.width - 0.5);
            weights.push_back(filtered_luminance(e, packed.environment_tint, x, y) * solid_angle);
            mean += weights.back() / (4 * std::numbers::pi);
            heading += weights.back() * glm::dvec3(sine * std::sin(turn), height, -sine * std::cos(turn));
        }
    }
    packed.environment_mean = mean;
    packed.environment_heading = mean > 0 ? heading / (4 * std::numbers::pi * mean) : glm::dvec3(0);
    const std::vector<double> pmf = pick_probabilities(weights, 0.0);
    packed.environment_texels.reserve(e.texels.size());
    for (std::size_t i = 0; i < e.texels.size(); ++i) {
        packed.environment_texels.emplace_back(e.texels[i], static_cast<float>(pmf[i]));
    }
    if (samples_lights(settings.integrator) && mean > 0) {
        packed.environment_table = build_alias_table(pmf);
    }
    place_environment(scene, packed);
}

}  // namespace diptych::core
