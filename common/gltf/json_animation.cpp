#include "gltf/json_animation.h"

namespace diptych::core::gltf {
namespace {

Json node_target(int node, const char* path) {
    return {{"node", node}, {"path", path}};
}

Json pointer_target(const std::string& pointer) {
    Json out = {{"path", "pointer"}};
    out["extensions"]["KHR_animation_pointer"]["pointer"] = pointer;
    return out;
}

Json json_target(const Channel& channel, int first_node, std::set<std::string>& extensions) {
    const std::string index = std::to_string(channel.target);
    switch (channel.property) {
    case AnimatedProperty::translation:
        return node_target(first_node + channel.target, "translation");
    case AnimatedProperty::rotation:
        return node_target(first_node + channel.target, "rotation");
    case AnimatedProperty::scale:
        return node_target(first_node + channel.target, "scale");
    default:
        extensions.insert("KHR_animation_pointer");
    }
    switch (channel.property) {
    case AnimatedProperty::emissive_factor:
        return pointer_target("/materials/" + index + "/emissiveFactor");
    case AnimatedProperty::emissive_strength:
        return pointer_target("/materials/" + index + "/extensions/KHR_materials_emissive_strength/emissiveStrength");
    default:
        return pointer_target("/extensions/KHR_lights_punctual/lights/" + index + "/intensity");
    }
}

const char* name_of(Interpolation interpolation) {
    return interpolation == Interpolation::step     ? "STEP"
           : interpolation == Interpolation::linear ? "LINEAR"
                                                    : "CUBICSPLINE";
}

}  // namespace

Json json_node(const Node& node) {
    Json out = Json::object();
    if (!node.name.empty()) {
        out["name"] = node.name;
    }
    if (node.matrix) {
        place(out, *node.matrix);
        return out;
    }
    if (node.translation != glm::dvec3(0)) {
        out["translation"] = json_vector(node.translation);
    }
    if (node.rotation != glm::dvec4(0, 0, 0, 1)) {
        out["rotation"] = json_vector(node.rotation);
    }
    if (node.scale != glm::dvec3(1)) {
        out["scale"] = json_vector(node.scale);
    }
    return out;
}

Json json_animation(const Animation& animation, int first_node, const AddAccessor& add_accessor,
                    std::set<std::string>& extensions) {
    Json out;
    if (!animation.name.empty()) {
        out["name"] = animation.name;
    }
    Json samplers = Json::array(), channels = Json::array();
    for (const Channel& channel : animation.channels) {
        channels.push_back({{"sampler", samplers.size()}, {"target", json_target(channel, first_node, extensions)}});
        samplers.push_back({{"input", add_accessor(channel.times, 1, true)},
                            {"interpolation", name_of(channel.interpolation)},
                            {"output", add_accessor(channel.values, component_count(channel.property), false)}});
    }
    out["samplers"] = samplers;
    out["channels"] = channels;
    return out;
}

}  // namespace diptych::core::gltf
