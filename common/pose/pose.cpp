#include "pose/pose.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "error.h"

namespace diptych::core {
namespace {

glm::vec3 radiance(const glm::dvec3& color, double factor) {
    constexpr double largest = std::numeric_limits<float>::max();
    return glm::vec3(glm::clamp(color * factor, 0.0, largest));
}

float from_zero(double value) {
    return static_cast<float>(std::max(value, 0.0));
}

bool moves_node(const Channel& channel) {
    return channel.property == AnimatedProperty::translation || channel.property == AnimatedProperty::rotation ||
           channel.property == AnimatedProperty::scale;
}

template <typename Function>
void for_each_playing(const Scene& scene, const Function& function) {
    for (const Animation& animation : scene.animations) {
        for (const Channel& channel : animation.channels) {
            if (channel.plays) {
                function(channel);
            }
        }
    }
}

void set_node(Node& node, AnimatedProperty property, const glm::dvec4& value) {
    if (property == AnimatedProperty::translation) {
        node.translation = glm::dvec3(value);
    } else if (property == AnimatedProperty::rotation) {
        node.rotation = value;
    } else {
        node.scale = glm::dvec3(value);
    }
}

void set_property(Scene& scene, const Channel& channel, const glm::dvec4& value) {
    const auto target = static_cast<std::size_t>(channel.target);
    switch (channel.property) {
    case AnimatedProperty::translation:
    case AnimatedProperty::rotation:
    case AnimatedProperty::scale:
        set_node(scene.nodes[target], channel.property, value);
        break;
    case AnimatedProperty::emissive_factor:
        scene.materials[target].moving_emission->factor = glm::max(glm::vec3(value), glm::vec3(0));
        break;
    case AnimatedProperty::emissive_strength:
        scene.materials[target].moving_emission->strength = from_zero(value.x);
        break;
    case AnimatedProperty::light_intensity:
        scene.lights[target].intensity =
            radiance(glm::dvec3(*scene.lights[target].moving_color), std::max(value.x, 0.0));
        break;
    }
}

bool is_finite(const glm::dmat4& matrix) {
    double sum = 0;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            sum += matrix[column][row] * 0;
        }
    }
    return sum == 0;
}

[[noreturn]] void fail(const Scene& scene, const std::string& object, double seconds, const char* reason) {
    throw Error(scene.name + ": " + object + " at " + std::to_string(seconds) + " s: " + reason);
}

std::vector<glm::dmat4> place_nodes(const Scene& scene, const std::vector<Node>& nodes, double seconds) {
    std::vector<glm::dmat4> to_world;
    to_world.reserve(nodes.size());
    for (const Node& node : nodes) {
        const glm::dmat4 local = node_matrix(node);
        to_world.push_back(node.parent == none ? local : to_world[static_cast<std::size_t>(node.parent)] * local);
        if (!is_finite(to_world.back())) {
            fail(scene, "node '" + node.name + "'", seconds, "has a transform that is not finite");
        }
    }
    return to_world;
}

glm::dmat4 view_of(const Scene& scene, const std::optional<glm::dmat4>& rigid, const std::string& object,
                   double seconds) {
    if (!rigid) {
        fail(scene, object, seconds, "has a transform without a direction to look along");
    }
    return *rigid;
}

}  // namespace

bool moves(const Scene& scene) {
    bool any = false;
    for_each_playing(scene, [&](const Channel&) { any = true; });
    return any;
}

double duration(const Scene& scene) {
    double seconds = 0;
    for_each_playing(scene, [&](const Channel& channel) {
        seconds = std::max(seconds, static_cast<double>(channel.times.back()));
    });
    return seconds;
}

void pose_scene(Scene& scene, double seconds) {
    for_each_playing(
        scene, [&](const Channel& channel) { set_property(scene, channel, sample_channel(channel, seconds)); });
    for (Material& material : scene.materials) {
        if (material.moving_emission) {
            material.emission = radiance(glm::dvec3(material.moving_emission->factor),
                                         static_cast<double>(material.moving_emission->strength));
        }
    }
    const std::vector<glm::dmat4> to_world = place_nodes(scene, scene.nodes, seconds);
    const auto of = [&](int node) -> const glm::dmat4& { return to_world[static_cast<std::size_t>(node)]; };
    for (Instance& instance : scene.instances) {
        if (instance.node != none) {
            instance.object_to_world = of(instance.node);
        }
    }
    for (Camera& camera : scene.cameras) {
        if (camera.node != none) {
            const std::optional<glm::dmat4> placed = rigid_placement(scene.nodes, camera.node, of(camera.node));
            camera.camera_to_world = view_of(scene, placed, "camera '" + camera.name + "'", seconds);
        }
    }
    for (PunctualLight& light : scene.lights) {
        if (light.node != none) {
            const std::optional<glm::dmat4> placed =
                light_placement(light.type, scene.nodes, light.node, of(light.node));
            light.light_to_world = view_of(scene, placed, "light '" + light.name + "'", seconds);
        }
    }
}

Camera camera_at(const Scene& scene, std::size_t camera, double seconds) {
    Camera posed = scene.cameras[camera];
    if (posed.node == none) {
        return posed;
    }
    std::vector<Node> nodes = scene.nodes;
    for_each_playing(scene, [&](const Channel& channel) {
        if (moves_node(channel)) {
            set_node(nodes[static_cast<std::size_t>(channel.target)], channel.property,
                     sample_channel(channel, seconds));
        }
    });
    const std::vector<glm::dmat4> to_world = place_nodes(scene, nodes, seconds);
    posed.camera_to_world =
        view_of(scene, rigid_placement(nodes, posed.node, to_world[static_cast<std::size_t>(posed.node)]),
                "camera '" + posed.name + "'", seconds);
    return posed;
}

std::optional<glm::dmat4> rigid_placement(const std::vector<Node>& nodes, int node, const glm::dmat4& to_world) {
    std::optional<glm::dmat4> rigid = rigid_part(to_world);
    if (!rigid) {
        glm::dmat4 turned(1);
        for (int i = node; i != none; i = nodes[static_cast<std::size_t>(i)].parent) {
            Node unscaled = nodes[static_cast<std::size_t>(i)];
            unscaled.scale = glm::dvec3(1);
            turned = node_matrix(unscaled) * turned;
        }
        rigid = rigid_part(turned);
    }
    if (rigid) {
        (*rigid)[3] = to_world[3];
    }
    return rigid;
}

std::optional<glm::dmat4> light_placement(PunctualType type, const std::vector<Node>& nodes, int node,
                                          const glm::dmat4& to_world) {
    std::optional<glm::dmat4> rigid = rigid_placement(nodes, node, to_world);
    if (!rigid && type == PunctualType::point) {
        rigid = glm::dmat4(1);
        (*rigid)[3] = to_world[3];
    }
    return rigid;
}

std::optional<glm::dmat4> rigid_part(const glm::dmat4& matrix) {
    const glm::dvec3 back(matrix[2]);
    const double back_length = glm::length(back);
    const glm::dvec3 z = back / back_length;
    const glm::dvec3 up(matrix[1]);
    const glm::dvec3 level = up - z * glm::dot(z, up);
    const double level_length = glm::length(level);
    if (!(back_length > 0) || !std::isfinite(back_length) || !(level_length > 1e-12 * glm::length(up))) {
        return std::nullopt;
    }
    const glm::dvec3 y = level / level_length;
    glm::dmat4 rigid(1);
    rigid[0] = glm::dvec4(glm::cross(y, z), 0);
    rigid[1] = glm::dvec4(y, 0);
    rigid[2] = glm::dvec4(z, 0);
    rigid[3] = glm::dvec4(glm::dvec3(matrix[3]), 1);
    return rigid;
}

}  // namespace diptych::core
