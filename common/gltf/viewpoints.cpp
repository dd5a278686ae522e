#include "gltf/viewpoints.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pose/pose.h"

namespace diptych::core::gltf {
namespace {

void import_perspective(Document& document, const tinygltf::PerspectiveCamera& source, const std::string& object,
                        Camera& camera) {
    if (!(source.yfov > 0) || !(source.yfov < std::numbers::pi)) {
        fail(document, object + ".perspective.yfov", "is " + std::to_string(source.yfov) + ", not between 0 and pi");
    }
    camera.vertical_fov = source.yfov;
    if (source.aspectRatio > 0) {
        camera.aspect = source.aspectRatio;
    } else if (source.aspectRatio < 0) {
        warn(document, object + ".perspective.aspectRatio", "is negative; left out");
    }
}

void import_orthographic(Document& document, const tinygltf::OrthographicCamera& source, const std::string& object,
                         Camera& camera) {
    const double height = 2 * std::abs(source.ymag);
    const double width = 2 * std::abs(source.xmag);
    if (!(height > 0) || !(width > 0) || !std::isfinite(height)) {
        fail(document, object + ".orthographic", "xmag and ymag must not be 0");
    }
    if (source.xmag < 0 || source.ymag < 0) {
        warn(document, object + ".orthographic", "xmag or ymag is negative; its sign is left out");
    }
    camera.orthographic = true;
    camera.orthographic_height = height;
    camera.aspect = width / height;
}

double angle_in(Document& document, double angle, double low, double high, const std::string& object) {
    const double clamped = std::clamp(angle, low, high);
    if (clamped != angle) {
        warn(document, object, "is out of range; clamped to " + std::to_string(clamped));
    }
    return clamped;
}

}  // namespace

Camera import_camera(Document& document, int index, int node, const NodeTree& tree) {
    if (index < 0 || static_cast<std::size_t>(index) >= document.model.cameras.size()) {
        fail(document, node_label(document, node) + ".camera", "there is no cameras[" + std::to_string(index) + "]");
    }
    const tinygltf::Camera& source = document.model.cameras[static_cast<std::size_t>(index)];
    const std::string object = label("cameras", static_cast<std::size_t>(index), source.name);
    const std::string& node_name = document.model.nodes[static_cast<std::size_t>(node)].name;
    Camera camera;
    camera.name = !node_name.empty()     ? node_name
                  : !source.name.empty() ? source.name
                                         : "camera" + std::to_string(index);
    const glm::dmat4& to_world = tree.to_world[static_cast<std::size_t>(node)];
    camera.camera_to_world = require_direction(document, rigid_placement(tree.nodes, node, to_world), node);
    if (source.type == "orthographic") {
        import_orthographic(document, source.orthographic, object, camera);
    } else {
        import_perspective(document, source.perspective, object, camera);
    }
    return camera;
}

int find_light(const Document& document, int node) {
    const tinygltf::Node& holder = document.model.nodes[static_cast<std::size_t>(node)];
    const auto extension = holder.extensions.find("KHR_lights_punctual");
    if (extension == holder.extensions.end()) {
        return none;
    }
    const std::string holder_name = node_label(document, node);
    if (!extension->second.Has("light") || !extension->second.Get("light").IsInt()) {
        fail(document, holder_name + ".KHR_lights_punctual", "names no light");
    }
    const int index = extension->second.Get("light").GetNumberAsInt();
    if (index < 0 || static_cast<std::size_t>(index) >= document.model.lights.size()) {
        fail(document, holder_name + ".KHR_lights_punctual", "there is no lights[" + std::to_string(index) + "]");
    }
    return index;
}

PunctualLight import_light(Document& document, int index, int node, const NodeTree& tree) {
    const tinygltf::Node& holder = document.model.nodes[static_cast<std::size_t>(node)];
    const tinygltf::Light& source = document.model.lights[static_cast<std::size_t>(index)];
    const std::string object = label("lights", static_cast<std::size_t>(index), source.name);
    PunctualLight light;
    light.name = !holder.name.empty() ? holder.name : source.name;
    if (source.type == "directional") {
        light.type = PunctualType::directional;
    } else if (source.type == "spot") {
        light.type = PunctualType::spot;
        const double quarter = std::numbers::pi / 2;
        light.outer_cone = angle_in(document, source.spot.outerConeAngle, 0, quarter, object + ".outerConeAngle");
        light.inner_cone =
            angle_in(document, source.spot.innerConeAngle, 0, light.outer_cone, object + ".innerConeAngle");
    } else if (source.type != "point") {
        fail(document, object + ".type", "is '" + source.type + "', which KHR_lights_punctual does not have");
    }
    const glm::dmat4& to_world = tree.to_world[static_cast<std::size_t>(node)];
    light.light_to_world =
        require_direction(document, light_placement(light.type, tree.nodes, node, to_world), node);
    if (!source.color.empty() && source.color.size() != 3) {
        fail(document, object + ".color", "has " + std::to_string(source.color.size()) + " numbers instead of 3");
    }
    for (int i = 0; i < 3; ++i) {
        const double color = source.color.empty() ? 1 : source.color[static_cast<std::size_t>(i)];
        const auto value = static_cast<float>(color * source.intensity);
        if (!(value >= 0) || !std::isfinite(value)) {
            fail(document, object, "has an intensity that is negative or not finite");
        }
        light.intensity[i] = value;
    }
    return light;
}

}  // namespace diptych::core::gltf
