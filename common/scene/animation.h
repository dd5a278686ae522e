// Keyframed motion, as glTF 2.0 and KHR_animation_pointer say it, and the nodes that it moves.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/warnings.h"

namespace diptych::core {

/// A local frame that moves, or that something moving hangs in. A node with a matrix is never itself a target.
struct Node {
    std::string name;
    int parent = -1;  // an earlier node, or none
    glm::dvec3 translation{0};
    glm::dvec4 rotation{0, 0, 0, 1};  // unit quaternion, x y z w
    glm::dvec3 scale{1};
    std::optional<glm::dmat4> matrix{};  // instead of the three above
};

/// Node to parent.
glm::dmat4 node_matrix(const Node& node);

enum class Interpolation { step, linear, cubic_spline };

enum class AnimatedProperty { translation, rotation, scale, emissive_factor, emissive_strength, light_intensity };

/// How many numbers a value of the property has.
int component_count(AnimatedProperty property);

/// One property over time. `times` never fall, in seconds; two equal ones are a jump. `values` holds component_count
/// numbers a key, and with cubic splines three such groups: in-tangent, value, out-tangent (per second).
struct Channel {
    AnimatedProperty property = AnimatedProperty::translation;
    int target = -1;  // index into the scene's nodes, materials or lights, as the property says
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;
    std::vector<float> values;
    bool plays = true;  // false: another clip was chosen, or another one moves the same target
};

/// A clip.
struct Animation {
    std::string name;
    std::vector<Channel> channels;  // empty where the file's channels move nothing that can be moved
    Warnings warnings{};            // of interest where the clip is played
};

/// The property's value, in the first component_count components; before the first key that key's, after the last that
/// one's. glTF 2.0, appendix C; rotations go the short way (slerp) and come out unit.
glm::dvec4 sample_channel(const Channel& channel, double seconds);

/// The last key's time, or 0 where that is earlier.
double duration(const Animation& animation);

}  // namespace diptych::core
