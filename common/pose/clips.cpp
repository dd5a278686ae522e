#include "pose/clips.h"

#include <algorithm>
#include <charconv>
#include <map>

#include "error.h"
#include "near_miss.h"

namespace diptych::core {
namespace {

// Tables that a channel's target is an index into.
enum class Table { nodes, materials, lights };

Table table_of(AnimatedProperty property) {
    switch (property) {
    case AnimatedProperty::emissive_factor:
    case AnimatedProperty::emissive_strength:
        return Table::materials;
    case AnimatedProperty::light_intensity:
        return Table::lights;
    default:
        return Table::nodes;
    }
}

std::string clip_label(const Scene& scene, std::size_t clip) {
    return std::to_string(clip) + " '" + scene.animations[clip].name + "'";
}

}  // namespace

void play_clip(Scene& scene, std::size_t clip) {
    for (std::size_t i = 0; i < scene.animations.size(); ++i) {
        if (i != clip) {
            scene.animations[i].warnings = {};
        }
        for (Channel& channel : scene.animations[i].channels) {
            channel.plays = i == clip;
        }
    }
}

void play_all_clips(Scene& scene) {
    std::map<std::pair<Table, int>, std::size_t> owners;
    for (std::size_t i = 0; i < scene.animations.size(); ++i) {
        for (Channel& channel : scene.animations[i].channels) {
            const std::size_t owner = owners.try_emplace({table_of(channel.property), channel.target}, i).first->second;
            channel.plays = owner == i;
            if (!channel.plays) {
                scene.animations[owner].warnings.add(
                    "plays, as the first of several clips for one target; `clip` chooses another one",
                    scene.name + ": clip " + clip_label(scene, owner), clip_label(scene, i) + " does not play there");
            }
        }
    }
}

std::size_t find_clip(const Scene& scene, const std::string& wanted) {
    const auto named = std::find_if(scene.animations.begin(), scene.animations.end(),
                                    [&](const Animation& animation) { return animation.name == wanted; });
    if (named != scene.animations.end()) {
        return static_cast<std::size_t>(named - scene.animations.begin());
    }
    std::size_t index = 0;
    const char* end = wanted.data() + wanted.size();
    const auto [stop, failure] = std::from_chars(wanted.data(), end, index);
    if (failure == std::errc() && stop == end && index < scene.animations.size()) {
        return index;
    }
    std::string list;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scene.animations.size(); ++i) {
        list += (i == 0 ? "" : ", ") + clip_label(scene, i);
        names.push_back(scene.animations[i].name);
    }
    throw Error(scene.name + ": no clip '" + wanted + "'" + did_you_mean(wanted, names) + "; there are " +
                (list.empty() ? "none" : list));
}

Warnings clip_warnings(const Scene& scene) {
    Warnings warnings;
    for (const Animation& animation : scene.animations) {
        const std::vector<Channel>& channels = animation.channels;
        const bool plays = std::any_of(channels.begin(), channels.end(), [](const Channel& c) { return c.plays; });
        if (plays || channels.empty()) {  // a clip may be empty because all of its channels are faulty
            warnings.append(animation.warnings);
        }
    }
    return warnings;
}

}  // namespace diptych::core
