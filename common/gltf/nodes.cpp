#include "gltf/nodes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "pose/pose.h"

namespace diptych::core::gltf {
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

glm::dvec4 unit_rotation(Document& document, const std::vector<double>& q, const std::string& object) {
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 0) || !std::isfinite(length)) {
        fail(document, object + ".rotation", "is not a quaternion of unit length");
    }
    if (std::abs(length - 1) > 1e-3) {
        warn(document, object + ".rotation", "is no unit quaternion; normalised");
    }
    return {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
}

void check_size(const Document& document, const std::vector<double>& values, std::size_t size,
                const std::string& object) {
    if (!values.empty() && values.size() != size) {
        fail(document, object, "has " + std::to_string(values.size()) + " numbers instead of " + std::to_string(size));
    }
}

Node read_node(Document& document, const tinygltf::Node& source, const std::string& object) {
    check_size(document, source.matrix, 16, object + ".matrix");
    check_size(document, source.translation, 3, object + ".translation");
    check_size(document, source.rotation, 4, object + ".rotation");
    check_size(document, source.scale, 3, object + ".scale");
    Node node;
    node.name = source.name;
    if (!source.matrix.empty()) {
        glm::dmat4 matrix(1);
        for (int i = 0; i < 16; ++i) {
            matrix[i / 4][i % 4] = source.matrix[static_cast<std::size_t>(i)];
        }
        if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1) {
            warn(document, object + ".matrix", "is not affine; its last row is taken as 0 0 0 1");
            matrix[0][3] = matrix[1][3] = matrix[2][3] = 0;
            matrix[3][3] = 1;
        }
        node.matrix = matrix;
        return node;
    }
    if (!source.rotation.empty()) {
        node.rotation = unit_rotation(document, source.rotation, object);
    }
    for (int i = 0; i < 3 && !source.scale.empty(); ++i) {
        node.scale[i] = source.scale[static_cast<std::size_t>(i)];
    }
    for (int i = 0; i < 3 && !source.translation.empty(); ++i) {
        node.translation[i] = source.translation[static_cast<std::size_t>(i)];
    }
    return node;
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

// Of each node, whether one of its ancestors is marked. `order` has parents first.
std::vector<bool> below(const std::vector<bool>& marked, const std::vector<int>& parents, const std::vector<int>& order) {
    std::vector<bool> hangs(marked.size(), false);
    for (const int node : order) {
        const int parent = parents[static_cast<std::size_t>(node)];
        if (parent != none) {
            const auto above = static_cast<std::size_t>(parent);
            hangs[static_cast<std::size_t>(node)] = marked[above] || hangs[above];
        }
    }
    return hangs;
}

// The topmost nodes of the scene. One that has a parent is no root, but some exporters list all nodes of a scene.
std::vector<int> scene_roots(Document& document, const std::vector<int>& parents, const std::vector<int>& all_roots,
                             const std::vector<int>& order) {
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
        if (seen[static_cast<std::size_t>(node)]) {
            warn(document, node_label(document, node), "is listed twice in " + object);
            continue;
        }
        if (parents[static_cast<std::size_t>(node)] != none) {
            warn(document, node_label(document, node),
                 "is listed in " + object + ", but has a parent; it is drawn once, in its place under that parent");
        }
        seen[static_cast<std::size_t>(node)] = true;
        roots.push_back(node);
    }
    const std::vector<bool> hangs = below(seen, parents, order);
    std::erase_if(roots, [&](int node) { return hangs[static_cast<std::size_t>(node)]; });
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
    tree.nodes.resize(parents.size());
    tree.to_world.assign(parents.size(), glm::dmat4(1));
    std::vector<bool> reached(parents.size(), false);
    const std::vector<int> order = descend(document, roots);
    for (const int node : order) {
        const auto i = static_cast<std::size_t>(node);
        const std::string object = node_label(document, node);
        reached[i] = true;
        tree.nodes[i] = read_node(document, document.model.nodes[i], object);
        tree.nodes[i].parent = parents[i];
        tree.to_world[i] = node_matrix(tree.nodes[i]);
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
    tree.visible = descend(document, scene_roots(document, parents, roots, order));
    std::vector<bool> carries(parents.size(), false);
    for (const int node : tree.visible) {
        for (int up = node; up != none && !carries[static_cast<std::size_t>(up)];
             up = parents[static_cast<std::size_t>(up)]) {
            carries[static_cast<std::size_t>(up)] = true;
        }
    }
    std::copy_if(order.begin(), order.end(), std::back_inserter(tree.carrying),
                 [&](int node) { return carries[static_cast<std::size_t>(node)]; });
    return tree;
}

glm::dmat4 require_direction(const Document& document, const std::optional<glm::dmat4>& placed, int node) {
    if (!placed) {
        fail(document, node_label(document, node), "has a transform without a direction to look along");
    }
    return *placed;
}

}  // namespace diptych::core::gltf
