#include "gltf/animation.h"

#include <set>
#include <utility>

#include "gltf/channel.h"
#include "gltf/material.h"

namespace diptych::core::gltf {
namespace {

using ParsedJson = nlohmann::json;

Animation read_animation(Document& document, const ParsedJson& source, std::size_t index) {
    Animation animation;
    if (source.is_object() && source.contains("name") && source["name"].is_string()) {
        animation.name = source["name"].get<std::string>();
    }
    const std::string object = label("animations", index, animation.name);
    if (!source.is_object() || !source.contains("channels") || !source["channels"].is_array()) {
        fail(document, object + ".channels", "are missing or no array");
    }
    std::set<std::pair<AnimatedProperty, int>> targets;
    const ParsedJson& channels = source["channels"];
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const std::string name = object + "." + label("channels", i);
        if (std::optional<Channel> channel = read_channel(document, source, channels[i], name, animation.warnings)) {
            if (!targets.insert({channel->property, channel->target}).second) {
                warn(document, animation.warnings, name, "moves what an earlier channel moves; the later one wins");
            }
            animation.channels.push_back(*std::move(channel));
        }
    }
    return animation;
}

bool moves_node(const Channel& channel) {
    return channel.property == AnimatedProperty::translation || channel.property == AnimatedProperty::rotation ||
           channel.property == AnimatedProperty::scale;
}

void warn_of_skins(Document& document, const std::vector<bool>& moving) {
    for (const tinygltf::Skin& skin : document.model.skins) {
        for (const int joint : skin.joints) {
            if (joint >= 0 && static_cast<std::size_t>(joint) < moving.size() &&
                moving[static_cast<std::size_t>(joint)]) {
                warn(document, "animations", "move joints of skins, which stay as they are");
                return;
            }
        }
    }
}

}  // namespace

Motion read_motion(Document& document, const NodeTree& tree, Scene& scene) {
    Motion motion;
    for (std::size_t i = 0; i < document.animations.size(); ++i) {
        motion.animations.push_back(read_animation(document, document.animations[i], i));
    }
    motion.scene_nodes.assign(tree.nodes.size(), none);
    motion.moving.assign(tree.nodes.size(), false);
    for (const Animation& animation : motion.animations) {
        for (const Channel& channel : animation.channels) {
            if (moves_node(channel)) {
                motion.moving[static_cast<std::size_t>(channel.target)] = true;
            }
        }
    }
    std::vector<bool> kept = motion.moving;
    for (auto node = tree.carrying.rbegin(); node != tree.carrying.rend(); ++node) {
        const int parent = tree.nodes[static_cast<std::size_t>(*node)].parent;
        if (parent != none && kept[static_cast<std::size_t>(*node)]) {
            kept[static_cast<std::size_t>(parent)] = true;
        }
    }
    for (const int index : tree.carrying) {
        const auto i = static_cast<std::size_t>(index);
        const int parent = tree.nodes[i].parent;
        if (parent != none && motion.moving[static_cast<std::size_t>(parent)]) {
            motion.moving[i] = kept[i] = true;
        }
        if (kept[i]) {
            motion.scene_nodes[i] = static_cast<int>(scene.nodes.size());
            scene.nodes.push_back(tree.nodes[i]);
            scene.nodes.back().parent = parent == none ? none : motion.scene_nodes[static_cast<std::size_t>(parent)];
        }
    }
    warn_of_skins(document, motion.moving);
    return motion;
}

void attach_motion(Document& document, const Motion& motion, const std::vector<int>& light_sources, Scene& scene) {
    for (const Animation& source : motion.animations) {
        Animation animation{source.name, {}, source.warnings};
        const auto add = [&](const Channel& channel, int target) {
            animation.channels.push_back(channel);
            animation.channels.back().target = target;
        };
        for (const Channel& channel : source.channels) {
            const auto target = static_cast<std::size_t>(channel.target);
            if (moves_node(channel)) {
                if (motion.scene_nodes[target] != none) {
                    add(channel, motion.scene_nodes[target]);
                }
            } else if (channel.property == AnimatedProperty::light_intensity) {
                for (std::size_t light = 0; light < light_sources.size(); ++light) {
                    if (light_sources[light] == channel.target) {
                        const std::vector<double>& color = document.model.lights[target].color;
                        scene.lights[light].moving_color =
                            color.empty() ? glm::vec3(1) : glm::vec3(color[0], color[1], color[2]);
                        add(channel, static_cast<int>(light));
                    }
                }
            } else {
                const tinygltf::Material& material = document.model.materials[target];
                scene.materials[target].moving_emission =
                    read_emission(document, material, label("materials", target, material.name));
                add(channel, channel.target);
            }
        }
        scene.animations.push_back(std::move(animation));
    }
}

}  // namespace diptych::core::gltf
