#include "scene/gltf_nodes.h"

#include <cmath>
#include <cstdint>

#include "scene/scene.h"

namespace diptych::gltf {
namespace {

bool is_finite(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(matrix[column][row])) {
                return false;
            }
        }
    }
    return true;
}

glm::dmat4 rotation_matrix(Document& document, const std::vector<double>& q, const std::string& object) {
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 0) || !std::isfinite(length)) {
        fail(document, object + ".rotation", "is not a quaternion of unit length");
    }
    if (std::abs(length - 1) > 1e-3) {
        warn(document, object + ".rotation", "is no unit quaternion; normalised");
    }
    const double x = q[0] / length;
    const double y = q[1] / length;
    const double z = q[2] / length;
    const double w = q[3] / length;
    glm::dmat4 matrix(1);
    matrix[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0};
    matrix[1] = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0};
    matrix[2] = {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0};
    return matrix;
}

void check_size(const Document& document, const std::vector<double>& values, std::size_t size,
                const std::string& object) {
    if (!values.empty() && values.size() != size) {
        fail(document, object, "has " + std::to_string(values.size()) + " numbers instead of " + std::to_string(size));
    }
}

glm::dmat4 local_matrix(Document& document, const tinygltf::Node& node, const std::string& object) {
    check_size(document, node.matrix, 16, object + ".matrix");
    check_size(document, node.translation, 3, object + ".translation");
    check_size(document, node.rotation, 4, object + ".rotation");
    check_size(document, node.scale, 3, object + ".scale");
    glm::dmat4 matrix(1);
    if (!node.matrix.empty()) {
        for (int i = 0; i < 16; ++i) {
            matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        }
        if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1) {
            warn(document, object + ".matrix", "is not affine; its last row is taken as 0 0 0 1");
            matrix[0][3] = matrix[1][3] = matrix[2][3] = 0;
            matrix[3][3] = 1;
        }
        return matrix;
    }
    if (!node.rotation.empty()) {
        matrix = rotation_matrix(document, node.rotation, object);
    }
    for (int i = 0; i < 3 && !node.scale.empty(); ++i) {
        matrix[i] *= node.scale[static_cast<std::size_t>(i)];
    }
    for (int i = 0; i < 3 && !node.translation.empty(); ++i) {
        matrix[3][i] = node.translation[static_cast<std::size_t>(i)];
    }
    return matrix;
}

void check_node(const Document& document, int node, const std::string& object) {
    if (node < 0 || static_cast<std::size_t>(node) >= document.model.nodes.size()) {
        fail(document, object, "there is no nodes[" + std::to_string(node) + "]");
    }
}

std::vector<int> find_parents(const Document& document) {
    std::vector<int> parents(document.model.nodes.size(), none);
    for (std::size_t i = 0; i < parents.size(); ++i) {
        for (const int child : document.model.nodes[i].children) {
            check_node(document, child, node_label(document, static_cast<int>(i)) + ".children");
            int& parent = parents[static_cast<std::size_t>(child)];
            if (parent != none) {
                fail(document, node_label(document, child),
                     "has two parents, nodes[" + std::to_string(parent) + "] and nodes[" + std::to_string(i) + "]");
            }
            parent = static_cast<int>(i);
        }
    }
    return parents;
}

// All nodes from `roots` down, parents first. A chain of a million nodes must not exhaust the stack, so there is no
// recursion.
std::vector<int> descend(const Document& document, const std::vector<int>& roots) {
    std::vector<int> order;
    std::vector<int> open(roots.rbegin(), roots.rend());
    while (!open.empty()) {
        const int node = open.back();
        open.pop_back();
        order.push_back(node);
        const std::vector<int>& children = document.model.nodes[static_cast<std::size_t>(node)].children;
        open.insert(open.end(), children.rbegin(), children.rend());
    }
    return order;
}

std::vector<int> scene_roots(Document& document, const std::vector<int>& parents, const std::vector<int>& all_roots) {
    const tinygltf::Model& model = document.model;
    if (model.scenes.empty()) {
        return all_roots;
    }
    if (model.defaultScene != none &&
        (model.defaultScene < 0 || static_cast<std::size_t>(model.defaultScene) >= model.scenes.size())) {
        fail(document, "scene", "there is no scenes[" + std::to_string(model.defaultScene) + "]");
    }
    const std::size_t index = model.defaultScene == none ? 0 : static_cast<std::size_t>(model.defaultScene);
    const std::string object = label("scenes", index, model.scenes[index].name) + ".nodes";
    std::vector<bool> seen(model.nodes.size(), false);
    std::vector<int> roots;
    for (const int node : model.scenes[index].nodes) {
        check_node(document, node, object);
        if (parents[static_cast<std::size_t>(node)] != none) {
            fail(document, object, "nodes[" + std::to_string(node) + "] is not a root, it has a parent");
        }
        if (seen[static_cast<std::size_t>(node)]) {
            warn(document, object, "names nodes[" + std::to_string(node) + "] twice");
            continue;
        }
        seen[static_cast<std::size_t>(node)] = true;
        roots.push_back(node);
    }
    return roots;
}

}  // namespace

std::string node_label(const Document& document, int node) {
    return label("nodes", static_cast<std::size_t>(node), document.model.nodes[static_cast<std::size_t>(node)].name);
}

NodeTree read_nodes(Document& document) {
    const std::vector<int> parents = find_parents(document);
    std::vector<int> roots;
    for (std::size_t i = 0; i < parents.size(); ++i) {
        if (parents[i] == none) {
            roots.push_back(static_cast<int>(i));
        }
    }
    NodeTree tree;
    tree.to_world.assign(parents.size(), glm::dmat4(1));
    std::vector<bool> reached(parents.size(), false);
    for (const int node : descend(document, roots)) {
        const auto i = static_cast<std::size_t>(node);
        const std::string object = node_label(document, node);
        reached[i] = true;
        tree.to_world[i] = local_matrix(document, document.model.nodes[i], object);
        if (parents[i] != none) {
            tree.to_world[i] = tree.to_world[static_cast<std::size_t>(parents[i])] * tree.to_world[i];
        }
        if (!is_finite(tree.to_world[i])) {
            fail(document, object, "has a transform that is not finite");
        }
    }
    // Every node has one parent at most, so whatever no root leads to hangs in a circle.
    for (std::size_t i = 0; i < reached.size(); ++i) {
        if (!reached[i]) {
            fail(document, node_label(document, static_cast<int>(i)), "is its own ancestor");
        }
    }
    tree.visible = descend(document, scene_roots(document, parents, roots));
    return tree;
}

glm::dmat4 without_scale(const Document& document, const glm::dmat4& matrix, const std::string& object) {
    const glm::dvec3 back(matrix[2]);
    const double back_length = glm::length(back);
    const glm::dvec3 z = back / back_length;
    const glm::dvec3 up(matrix[1]);
    const glm::dvec3 level = up - z * glm::dot(z, up);
    const double level_length = glm::length(level);
    if (!(back_length > 0) || !(level_length > 1e-12 * glm::length(up))) {
        fail(document, object, "has a transform without a direction to look along");
    }
    const glm::dvec3 y = level / level_length;
    glm::dmat4 rigid(1);
    rigid[0] = glm::dvec4(glm::cross(y, z), 0);
    rigid[1] = glm::dvec4(y, 0);
    rigid[2] = glm::dvec4(z, 0);
    rigid[3] = glm::dvec4(glm::dvec3(matrix[3]), 1);
    return rigid;
}

}  // namespace diptych::gltf
