#include "scene/animation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace diptych::core {
namespace {

glm::dvec4 unit_or(const glm::dvec4& q, const glm::dvec4& fallback) {
    const double length = glm::length(q);
    return length > 0 ? q / length : fallback;
}

// glTF 2.0, appendix C.4. Where both are as good as parallel the chord is the arc.
glm::dvec4 slerp(const glm::dvec4& from, const glm::dvec4& to, double t) {
    const double cosine = glm::dot(from, to);
    const double sign = cosine < 0 ? -1 : 1;
    const double angle = std::acos(std::min(std::abs(cosine), 1.0));
    if (angle < 1e-6) {
        return unit_or((1 - t) * from + t * sign * to, from);
    }
    return (std::sin(angle * (1 - t)) * from + sign * std::sin(angle * t) * to) / std::sin(angle);
}

// The `group`th run of component_count numbers.
glm::dvec4 group_at(const Channel& channel, std::size_t group) {
    const int count = component_count(channel.property);
    glm::dvec4 value(0);
    for (int i = 0; i < count; ++i) {
        const std::size_t index = group * static_cast<std::size_t>(count) + static_cast<std::size_t>(i);
        assert(index < channel.values.size());
        value[i] = static_cast<double>(channel.values[index]);
    }
    return value;
}

glm::dvec4 key_value(const Channel& channel, std::size_t key) {
    const bool spline = channel.interpolation == Interpolation::cubic_spline;
    const glm::dvec4 value = group_at(channel, spline ? 3 * key + 1 : key);
    return channel.property == AnimatedProperty::rotation ? unit_or(value, {0, 0, 0, 1}) : value;
}

// glTF 2.0, appendix C.5, between keys k and k + 1 that lie `length` seconds apart.
glm::dvec4 spline(const Channel& channel, std::size_t k, double t, double length) {
    const double t2 = t * t;
    const double t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * group_at(channel, 3 * k + 1) +
           length * (t3 - 2 * t2 + t) * group_at(channel, 3 * k + 2) +
           (3 * t2 - 2 * t3) * group_at(channel, 3 * k + 4) + length * (t3 - t2) * group_at(channel, 3 * k + 3);
}

}  // namespace

glm::dmat4 node_matrix(const Node& node) {
    if (node.matrix) {
        return *node.matrix;
    }
    const double x = node.rotation.x;
    const double y = node.rotation.y;
    const double z = node.rotation.z;
    const double w = node.rotation.w;
    glm::dmat4 matrix(1);
    matrix[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0};
    matrix[1] = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0};
    matrix[2] = {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0};
    for (int i = 0; i < 3; ++i) {
        matrix[i] *= node.scale[i];
    }
    matrix[3] = glm::dvec4(node.translation, 1);
    return matrix;
}

int component_count(AnimatedProperty property) {
    switch (property) {
    case AnimatedProperty::rotation:
        return 4;
    case AnimatedProperty::emissive_strength:
    case AnimatedProperty::light_intensity:
        return 1;
    default:
        return 3;
    }
}

glm::dvec4 sample_channel(const Channel& channel, double seconds) {
    const std::vector<float>& times = channel.times;
    assert(!times.empty());
    const auto next = std::upper_bound(times.begin(), times.end(), seconds,
                                       [](double s, float time) { return s < static_cast<double>(time); });
    if (next == times.begin()) {
        return key_value(channel, 0);
    }
    const auto k = static_cast<std::size_t>(next - times.begin()) - 1;
    if (next == times.end() || channel.interpolation == Interpolation::step) {
        return key_value(channel, k);
    }
    const double length = static_cast<double>(times[k + 1]) - static_cast<double>(times[k]);
    const double t = (seconds - static_cast<double>(times[k])) / length;
    const bool rotates = channel.property == AnimatedProperty::rotation;
    if (channel.interpolation == Interpolation::cubic_spline) {
        const glm::dvec4 value = spline(channel, k, t, length);
        return rotates ? unit_or(value, key_value(channel, k)) : value;
    }
    const glm::dvec4 from = key_value(channel, k);
    const glm::dvec4 to = key_value(channel, k + 1);
    return rotates ? slerp(from, to, t) : (1 - t) * from + t * to;
}

double duration(const Animation& animation) {
    double seconds = 0;
    for (const Channel& channel : animation.channels) {
        seconds = std::max(seconds, static_cast<double>(channel.times.back()));
    }
    return seconds;
}

}  // namespace diptych::core
