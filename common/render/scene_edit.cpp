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

}  // namespace

bool editable_in_place(const Scene& scene, const Scene& edited) {
    return scene.meshes.size() == edited.meshes.size() &&
           std::equal(scene.materials.begin(), scene.materials.end(), edited.materials.begin(), edited.materials.end(),
                      same_in_structures) &&
           std::equal(scene.instances.begin(), scene.instances.end(), edited.instances.begin(), edited.instances.end(),
                      same_place);
}

}  // namespace diptych::core
