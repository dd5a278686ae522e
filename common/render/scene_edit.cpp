#include <algorithm>

#include "render/session.h"

namespace diptych::core {

namespace {

/// Acceleration structures know which triangles have alpha, and nothing else of materials: emitters are placed anew.
bool same_in_structures(const Material& a, const Material& b) {
    return a.alpha_mode == b.alpha_mode;
}

bool same_place(const Instance& a, const Instance& b) {
    return a.mesh == b.mesh && a.node == b.node && a.object_to_world == b.object_to_world;
}

bool same_frame(const Node& a, const Node& b) {
    return a.parent == b.parent && a.translation == b.translation && a.rotation == b.rotation && a.scale == b.scale &&
           a.matrix == b.matrix;
}

/// Whether the instances' nodes and all above them are the same: where a scale of 0 hides the difference at rest, a
/// moment may show it.
bool same_frames(const Scene& scene, const Scene& edited) {
    std::vector<bool> same(scene.nodes.size());
    for (std::size_t i = 0; i < same.size(); ++i) {
        const int parent = scene.nodes[i].parent;
        same[i] = same_frame(scene.nodes[i], edited.nodes[i]) &&
                  (parent == none || same[static_cast<std::size_t>(parent)]);
    }
    return std::all_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
        return instance.node == none || same[static_cast<std::size_t>(instance.node)];
    });
}

}  // namespace

bool editable_in_place(const Scene& scene, const Scene& edited) {
    return scene.meshes.size() == edited.meshes.size() &&
           std::equal(scene.materials.begin(), scene.materials.end(), edited.materials.begin(), edited.materials.end(),
                      same_in_structures) &&
           std::equal(scene.instances.begin(), scene.instances.end(), edited.instances.begin(), edited.instances.end(),
                      same_place) &&
           same_frames(scene, edited);
}

}  // namespace diptych::core
