#include "gltf/import.h"

#include <map>
#include <new>
#include <utility>

#include "error.h"
#include "gltf/accessor.h"
#include "gltf/animation.h"
#include "gltf/document.h"
#include "gltf/material.h"
#include "gltf/mesh.h"
#include "gltf/nodes.h"
#include "gltf/viewpoints.h"

namespace diptych::core {
namespace {

using namespace gltf;

// Meshes are shared between nodes that deform them alike; a skinned node has its own.
struct MeshTable {
    std::map<std::pair<int, std::vector<double>>, int> shared;
};

std::vector<double> morph_weights(Document& document, int node) {
    const tinygltf::Node& holder = document.model.nodes[static_cast<std::size_t>(node)];
    const tinygltf::Mesh& mesh = document.model.meshes[static_cast<std::size_t>(holder.mesh)];
    std::vector<double> weights = holder.weights.empty() ? mesh.weights : holder.weights;
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
        if (weights.size() > primitive.targets.size()) {
            warn(document, node_label(document, node), "has more weights than its mesh has morph targets");
        }
    }
    while (!weights.empty() && weights.back() == 0) {
        weights.pop_back();
    }
    return weights;
}

std::vector<glm::dmat4> joint_matrices(Document& document, const NodeTree& tree, int skin_index, int node) {
    if (skin_index < 0 || static_cast<std::size_t>(skin_index) >= document.model.skins.size()) {
        fail(document, node_label(document, node) + ".skin", "there is no skins[" + std::to_string(skin_index) + "]");
    }
    const tinygltf::Skin& skin = document.model.skins[static_cast<std::size_t>(skin_index)];
    const std::string object = label("skins", static_cast<std::size_t>(skin_index), skin.name);
    std::vector<float> inverse_bind;
    if (skin.inverseBindMatrices != none) {
        inverse_bind = read_numbers(document, skin.inverseBindMatrices, 16, object + ".inverseBindMatrices");
        if (inverse_bind.size() < skin.joints.size() * 16) {
            fail(document, object + ".inverseBindMatrices", "has fewer matrices than the skin has joints");
        }
    }
    std::vector<glm::dmat4> matrices;
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
        const int joint = skin.joints[j];
        if (joint < 0 || static_cast<std::size_t>(joint) >= tree.to_world.size()) {
            fail(document, object + ".joints", "there is no nodes[" + std::to_string(joint) + "]");
        }
        glm::dmat4 matrix(1);
        for (std::size_t i = 0; i < 16 && !inverse_bind.empty(); ++i) {
            matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = static_cast<double>(inverse_bind[j * 16 + i]);
        }
        matrices.push_back(tree.to_world[static_cast<std::size_t>(joint)] * matrix);
    }
    if (matrices.empty()) {
        fail(document, object + ".joints", "is empty");
    }
    return matrices;
}

int add_mesh(Document& document, Scene& scene, int mesh, const MeshUse& use) {
    scene.meshes.push_back(import_mesh(document, scene, mesh, use));
    return static_cast<int>(scene.meshes.size()) - 1;
}

/// Whether there is one: a mesh without triangles makes none.
bool add_instance(Document& document, Scene& scene, const NodeTree& tree, const Motion& motion, int node,
                  MeshTable& table) {
    const tinygltf::Node& holder = document.model.nodes[static_cast<std::size_t>(node)];
    if (holder.mesh < 0 || static_cast<std::size_t>(holder.mesh) >= document.model.meshes.size()) {
        fail(document, node_label(document, node) + ".mesh", "there is no meshes[" + std::to_string(holder.mesh) + "]");
    }
    Instance instance;
    instance.name = holder.name;
    MeshUse use{morph_weights(document, node), {}};
    if (holder.skin != none) {
        use.joints = joint_matrices(document, tree, holder.skin, node);
        instance.mesh = add_mesh(document, scene, holder.mesh, use);
    } else {
        instance.object_to_world = tree.to_world[static_cast<std::size_t>(node)];
        instance.node = motion.node(node);
        const auto [entry, added] = table.shared.try_emplace({holder.mesh, use.weights}, none);
        if (added) {
            entry->second = add_mesh(document, scene, holder.mesh, use);
        }
        instance.mesh = entry->second;
    }
    if (scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives.empty()) {
        return false;
    }
    scene.instances.push_back(std::move(instance));
    return true;
}

Scene import_document(Document& document, FileNodes* nodes) {
    Scene scene;
    scene.name = document.file;
    import_materials(document, scene);
    NodeTree tree = read_nodes(document);
    const Motion motion = read_motion(document, tree, scene);
    MeshTable table;
    std::vector<int> light_sources;
    std::vector<NodeUse> uses(nodes ? tree.nodes.size() : 0);
    const auto hang = [&](int NodeUse::*kind, int node, std::size_t count) {
        if (nodes) {
            uses[static_cast<std::size_t>(node)].*kind = static_cast<int>(count) - 1;
        }
    };
    for (const int node : tree.visible) {
        const tinygltf::Node& holder = document.model.nodes[static_cast<std::size_t>(node)];
        if (holder.mesh != none && add_instance(document, scene, tree, motion, node, table) && holder.skin == none) {
            hang(&NodeUse::instance, node, scene.instances.size());
        }
        if (holder.camera != none) {
            scene.cameras.push_back(import_camera(document, holder.camera, node, tree));
            scene.cameras.back().node = motion.node(node);
            hang(&NodeUse::camera, node, scene.cameras.size());
        }
        if (const int light = find_light(document, node); light != none) {
            scene.lights.push_back(import_light(document, light, node, tree));
            scene.lights.back().node = motion.node(node);
            hang(&NodeUse::light, node, scene.lights.size());
            light_sources.push_back(light);
        }
    }
    attach_motion(document, motion, light_sources, scene);
    if (scene.instances.empty()) {
        warn(document, "scene", "has no triangles");
    }
    scene.warnings = std::move(document.warnings);
    for (std::size_t i = 0; i < uses.size(); ++i) {
        uses[i].scene_node = motion.scene_nodes[i];
        uses[i].moves = motion.moving[i] && motion.scene_nodes[i] != none;
    }
    if (nodes) {
        *nodes = {std::move(tree.nodes), std::move(uses)};
    }
    return scene;
}

}  // namespace

Scene load_gltf(const std::filesystem::path& path, const GltfOptions& options, FileNodes* nodes) {
    try {
        Document document = read_document(path, options);
        return import_document(document, nodes);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error(path.string() + ": does not fit into memory");
    } catch (const std::exception& error) {
        throw Error(path.string() + ": " + error.what());
    }
}

}  // namespace diptych::core
