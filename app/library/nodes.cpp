// The file's node tree, and where it places what hangs in it.
#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <optional>

#include "library/impl.h"
#include "pose/pose.h"

DIPTYCH_BEGIN

namespace {

bool sets_node(const core::Channel& channel) {
    return channel.property == core::AnimatedProperty::translation ||
           channel.property == core::AnimatedProperty::rotation || channel.property == core::AnimatedProperty::scale;
}

/// Of Scene::nodes.
std::vector<bool> animated_nodes(const core::Scene& scene) {
    std::vector<bool> animated(scene.nodes.size());
    for (const core::Animation& animation : scene.animations) {
        for (const core::Channel& channel : animation.channels) {
            if (channel.plays && sets_node(channel)) {
                animated[static_cast<std::size_t>(channel.target)] = true;
            }
        }
    }
    return animated;
}

/// An animation sets one of these without the others, so its node keeps them apart.
void set_parts(const glm::dmat4& matrix, const std::string& name, core::Node& node) {
    const glm::dmat3 linear(matrix);
    glm::dvec3 scale(glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2]));
    if (glm::determinant(linear) < 0) {
        scale.x = -scale.x;
    }
    const glm::dmat3 turned(linear[0] / scale.x, linear[1] / scale.y, linear[2] / scale.z);
    const glm::dmat3 square = glm::transpose(turned) * turned;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            if (!(std::abs(square[i][j] - (i == j ? 1 : 0)) < 1e-4)) {  // also where a scale is 0
                throw Error(name + ": node_to_parent has to be a translation times a rotation times a scale other than "
                                   "0, because an animation sets these");
            }
        }
    }
    const glm::dquat q = glm::normalize(glm::quat_cast(turned));
    node.translation = glm::dvec3(matrix[3]);
    node.rotation = {q.x, q.y, q.z, q.w};
    node.scale = scale;
    node.matrix.reset();
}

/// Products from the top down, one factor after another, as the import and poses take them: the same bits.
std::vector<glm::dmat4> place(const std::vector<core::Node>& nodes) {
    std::vector<glm::dmat4> to_world(nodes.size());
    std::vector<bool> placed(nodes.size());
    std::vector<std::size_t> open;  // a node and its ancestors that are not placed; no recursion, as chains may be long
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (int at = static_cast<int>(i); at != core::none && !placed[static_cast<std::size_t>(at)];
             at = nodes[static_cast<std::size_t>(at)].parent) {
            open.push_back(static_cast<std::size_t>(at));
        }
        for (; !open.empty(); open.pop_back()) {
            const core::Node& node = nodes[open.back()];
            const glm::dmat4 local = core::node_matrix(node);
            to_world[open.back()] =
                node.parent == core::none ? local : to_world[static_cast<std::size_t>(node.parent)] * local;
            placed[open.back()] = true;
        }
    }
    return to_world;
}

/// Where one state of the tree places things.
class Placement {
public:
    explicit Placement(const core::FileNodes& nodes) : nodes_(nodes.nodes), to_world_(place(nodes_)) {}

    const glm::dmat4& to_world(std::size_t node) const { return to_world_[node]; }

    std::optional<glm::dmat4> of(const Instance& instance) const { return to_world(index(instance.node)); }
    std::optional<glm::dmat4> of(const Camera& camera) const {
        return core::rigid_placement(nodes_, camera.node, to_world(index(camera.node)));
    }
    std::optional<glm::dmat4> of(const Light& light) const {
        return core::light_placement(static_cast<core::PunctualType>(light.kind), nodes_, light.node,
                                     to_world(index(light.node)));
    }

private:
    static std::size_t index(int node) { return static_cast<std::size_t>(node); }

    const std::vector<core::Node>& nodes_;
    std::vector<glm::dmat4> to_world_;
};

/// The rows of a table, moved.
template <class Row>
std::vector<Row> followed(const std::vector<Row>& table, const char* name, Matrix Row::*matrix, const Placement& before,
                          const Placement& after) {
    std::vector<Row> rows = table;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        Row& row = rows[i];
        if (row.node == none) {
            continue;
        }
        const std::optional<glm::dmat4> stood = before.of(row);
        if (!stood || from_core(*stood) != row.*matrix) {
            row.node = none;
            continue;
        }
        const std::optional<glm::dmat4> stands = after.of(row);
        if (!stands) {
            throw Error(object(name, i, row.name) + ": its nodes' transform leaves no direction to look along");
        }
        row.*matrix = from_core(*stands);
    }
    return rows;
}

/// Whether what hangs in nodes is where it was.
template <class Row>
bool stand(const std::vector<Row>& before, const std::vector<Row>& after, Matrix Row::*matrix) {
    for (std::size_t i = 0; i < after.size(); ++i) {
        const bool same =
            i < before.size() && before[i].node == after[i].node && before[i].*matrix == after[i].*matrix;
        if (after[i].node != none && !same) {
            return false;
        }
    }
    return true;
}

/// References to the rows stay valid.
template <class Row>
void write(const std::vector<Row>& rows, std::vector<Row>& table) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        table[i] = rows[i];
    }
}

}  // namespace

std::vector<Node> nodes_of(const core::Scene& scene, const core::FileNodes& nodes) {
    const std::vector<bool> animated = animated_nodes(scene);
    std::vector<Node> table(nodes.nodes.size());
    for (std::size_t i = 0; i < table.size(); ++i) {
        const core::Node& node = nodes.nodes[i];
        const int moving = nodes.uses[i].scene_node;
        table[i].name = node.name;
        table[i].node_to_parent = from_core(core::node_matrix(node));
        table[i].parent = node.parent;
        table[i].animated = moving != core::none && animated[static_cast<std::size_t>(moving)];
        if (node.parent != core::none) {
            table[static_cast<std::size_t>(node.parent)].children.push_back(static_cast<int>(i));
        }
    }
    return table;
}

core::FileNodes edited_nodes(const Tables& before, const Tables& after, const core::FileNodes& nodes) {
    core::FileNodes edited = nodes;
    for (std::size_t i = 0; i < after.nodes.size(); ++i) {
        const Node& node = after.nodes[i];
        edited.nodes[i].name = node.name;
        if (node.node_to_parent == before.nodes[i].node_to_parent) {
            continue;
        }
        const glm::dmat4 matrix = to_core(node.node_to_parent);
        if (node.animated) {
            set_parts(matrix, object("nodes", i, node.name), edited.nodes[i]);
        } else {
            edited.nodes[i].matrix = matrix;
        }
    }
    const std::vector<glm::dmat4> to_world = place(edited.nodes);
    for (std::size_t i = 0; i < to_world.size(); ++i) {
        for (const double value : from_core(to_world[i])) {
            if (!std::isfinite(value)) {
                throw Error(object("nodes", i, after.nodes[i].name) + ": has a transform that is not finite");
            }
        }
    }
    return edited;
}

void follow_nodes(const core::FileNodes& before, const core::FileNodes& after, Tables& tables) {
    const Placement stood(before);
    const Placement stands(after);
    const auto instances = followed(tables.instances, "instances", &Instance::object_to_world, stood, stands);
    const auto cameras = followed(tables.cameras, "cameras", &Camera::camera_to_world, stood, stands);
    const auto lights = followed(tables.lights, "lights", &Light::light_to_world, stood, stands);
    write(instances, tables.instances);
    write(cameras, tables.cameras);
    write(lights, tables.lights);
}

void let_go_of_nodes(const Tables& before, const core::FileNodes& nodes, Tables& tables) {
    const bool all_stand = stand(before.instances, tables.instances, &Instance::object_to_world) &&
                           stand(before.cameras, tables.cameras, &Camera::camera_to_world) &&
                           stand(before.lights, tables.lights, &Light::light_to_world);
    if (!all_stand) {
        follow_nodes(nodes, nodes, tables);
    }
}

DIPTYCH_END
