#include "gltf/channel.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <string_view>

#include "gltf/accessor.h"

namespace diptych::core::gltf {
namespace {

using ParsedJson = nlohmann::json;

const ParsedJson* member(const ParsedJson& object, const char* key) {
    const auto found = object.is_object() ? object.find(key) : object.end();
    return found == object.end() ? nullptr : &*found;
}

int index_member(const Document& document, const ParsedJson& object, const char* key, std::size_t size, const char* table,
                 const std::string& name) {
    const ParsedJson* value = member(object, key);
    if (value == nullptr || !value->is_number_unsigned()) {
        fail(document, name + "." + key, "is missing or no index");
    }
    const auto index = value->get<std::uint64_t>();
    if (index >= size) {
        fail(document, name + "." + key, std::string("there is no ") + table + "[" + std::to_string(index) + "]");
    }
    return static_cast<int>(index);
}

struct Target {
    AnimatedProperty property;
    int index;
};

// "/table/7/property" as 7.
std::optional<int> pointer_index(std::string_view pointer, std::string_view table, std::string_view property) {
    if (pointer.size() <= table.size() + property.size() || pointer.substr(0, table.size()) != table ||
        pointer.substr(pointer.size() - property.size()) != property) {
        return std::nullopt;
    }
    const std::string_view digits = pointer.substr(table.size(), pointer.size() - table.size() - property.size());
    int index = 0;
    const auto [stop, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    const bool whole = failure == std::errc() && stop == digits.data() + digits.size();
    return whole && index >= 0 ? std::optional<int>(index) : std::nullopt;
}

// KHR_animation_pointer, as far as light is concerned.
std::optional<Target> pointer_target(Document& document, const ParsedJson& target, const std::string& object) {
    const ParsedJson* extensions = member(target, "extensions");
    const ParsedJson* extension = extensions != nullptr ? member(*extensions, "KHR_animation_pointer") : nullptr;
    const ParsedJson* pointer = extension != nullptr ? member(*extension, "pointer") : nullptr;
    if (pointer == nullptr || !pointer->is_string()) {
        fail(document, object + ".target", "has the path 'pointer', but KHR_animation_pointer names none");
    }
    const std::string text = pointer->get<std::string>();
    struct Known {
        const char* table;
        const char* property;
        AnimatedProperty meaning;
        std::size_t size;
    };
    const std::size_t materials = document.model.materials.size();
    const Known known[] = {
        {"/materials/", "/emissiveFactor", AnimatedProperty::emissive_factor, materials},
        {"/materials/", "/extensions/KHR_materials_emissive_strength/emissiveStrength",
         AnimatedProperty::emissive_strength, materials},
        {"/extensions/KHR_lights_punctual/lights/", "/intensity", AnimatedProperty::light_intensity,
         document.model.lights.size()},
    };
    for (const Known& k : known) {
        if (const std::optional<int> index = pointer_index(text, k.table, k.property)) {
            if (static_cast<std::size_t>(*index) >= k.size) {
                fail(document, object + ".target", "there is nothing at '" + text + "'");
            }
            return Target{k.meaning, *index};
        }
    }
    warn(document, "animations", "move '" + text + "', which stays as it is");
    return std::nullopt;
}

std::optional<Target> node_target(Document& document, const ParsedJson& target, const std::string& path,
                                  const std::string& object, Warnings& warnings) {
    AnimatedProperty property{};
    if (path == "translation") {
        property = AnimatedProperty::translation;
    } else if (path == "rotation") {
        property = AnimatedProperty::rotation;
    } else if (path == "scale") {
        property = AnimatedProperty::scale;
    } else {
        warn(document, "animations",
             path == "weights" ? "move morph targets, which stay as they are"
                               : "move '" + path + "', which glTF does not have");
        return std::nullopt;
    }
    if (!target.contains("node")) {
        warn(document, object + ".target", "names no node; left out");
        return std::nullopt;
    }
    const int node = index_member(document, target, "node", document.model.nodes.size(), "nodes", object + ".target");
    if (!document.model.nodes[static_cast<std::size_t>(node)].matrix.empty()) {
        warn(document, warnings, object + ".target", "moves a node that has a matrix; left out",
             "it is nodes[" + std::to_string(node) + "]");
        return std::nullopt;
    }
    return Target{property, node};
}

std::optional<Target> read_target(Document& document, const ParsedJson& channel, const std::string& object,
                                  Warnings& warnings) {
    const ParsedJson* target = member(channel, "target");
    const ParsedJson* path = target != nullptr ? member(*target, "path") : nullptr;
    if (path == nullptr || !path->is_string()) {
        fail(document, object + ".target.path", "is missing");
    }
    const std::string text = path->get<std::string>();
    return text == "pointer" ? pointer_target(document, *target, object)
                             : node_target(document, *target, text, object, warnings);
}

// What is unknown is taken for what the number of values allows: splines have three a key.
Interpolation read_interpolation(const Document& document, const ParsedJson& sampler, bool three_values_a_key,
                                 const std::string& object, Warnings& warnings) {
    const ParsedJson* value = member(sampler, "interpolation");
    if (value == nullptr || *value == "LINEAR") {
        return Interpolation::linear;
    }
    if (*value == "STEP") {
        return Interpolation::step;
    }
    if (*value == "CUBICSPLINE") {
        return Interpolation::cubic_spline;
    }
    const Interpolation taken = three_values_a_key ? Interpolation::cubic_spline : Interpolation::linear;
    warn(document, warnings, object + ".interpolation",
         std::string("is unknown; taken as ") + (three_values_a_key ? "CUBICSPLINE" : "LINEAR"),
         "it is " + value->dump());
    return taken;
}

std::vector<float> read_times(const Document& document, int accessor, const std::string& object) {
    if (find_accessor(document, accessor, object).componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
        fail(document, object, "holds times that are no floats");
    }
    return read_numbers(document, accessor, 1, object);
}

// Times that are finite, but do not rise from 0: they are put in order. Equal ones keep theirs, and are a jump.
void repair_times(const Document& document, Channel& channel, const std::string& object, Warnings& warnings) {
    std::vector<float>& times = channel.times;
    const auto detail = [&](std::size_t i) { return "time " + std::to_string(i) + " is " + std::to_string(times[i]); };
    const auto early = std::find_if(times.begin(), times.end(), [](float time) { return time < 0; });
    if (early != times.end()) {
        warn(document, warnings, object, "has keys before 0 s; they are played from 0 s on",
             detail(static_cast<std::size_t>(early - times.begin())));
    }
    const auto repeated = std::adjacent_find(times.begin(), times.end());
    if (repeated != times.end()) {
        warn(document, warnings, object, "has two keys at one time; the value jumps there",
             detail(static_cast<std::size_t>(repeated - times.begin()) + 1));
    }
    const auto fallen = std::is_sorted_until(times.begin(), times.end());
    if (fallen == times.end()) {
        return;
    }
    warn(document, warnings, object, "has keys that are not in order of time; they are sorted",
         detail(static_cast<std::size_t>(fallen - times.begin())));
    std::vector<std::size_t> order(times.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return times[a] < times[b]; });
    const Channel unsorted = channel;
    const std::size_t group = channel.values.size() / times.size();
    for (std::size_t key = 0; key < order.size(); ++key) {
        times[key] = unsorted.times[order[key]];
        std::copy_n(&unsorted.values[order[key] * group], group, &channel.values[key * group]);
    }
}

// Why the keyframes cannot be played at all; empty where they can.
std::string problem_of(const Channel& channel) {
    const auto finite = [](float x) { return std::isfinite(x); };
    if (channel.times.empty()) {
        return "has no keys";
    }
    if (!std::all_of(channel.times.begin(), channel.times.end(), finite)) {
        return "has a time that is not finite";
    }
    if (!std::all_of(channel.values.begin(), channel.values.end(), finite)) {
        return "has a value that is not finite";
    }
    const bool spline = channel.interpolation == Interpolation::cubic_spline;
    for (std::size_t key = 0; key < channel.times.size() && channel.property == AnimatedProperty::rotation; ++key) {
        const float* q = &channel.values[4 * (spline ? 3 * key + 1 : key)];
        if (q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0) {
            return "has a value that is no rotation";
        }
    }
    return "";
}

}  // namespace

std::optional<Channel> read_channel(Document& document, const ParsedJson& animation, const ParsedJson& channel,
                                    const std::string& object, Warnings& warnings) {
    const ParsedJson* samplers = member(animation, "samplers");
    const int index =
        index_member(document, channel, "sampler", samplers != nullptr ? samplers->size() : 0, "samplers", object);
    const std::optional<Target> target = read_target(document, channel, object, warnings);
    if (!target) {
        return std::nullopt;
    }
    if (!samplers->is_array()) {
        fail(document, object, "the animation's samplers are no array");
    }
    const ParsedJson& sampler = (*samplers)[static_cast<std::size_t>(index)];
    const std::string name = object + ".samplers[" + std::to_string(index) + "]";
    const std::size_t accessors = document.model.accessors.size();
    Channel out;
    out.property = target->property;
    out.target = target->index;
    out.times =
        read_times(document, index_member(document, sampler, "input", accessors, "accessors", name), name + ".input");
    const auto components = static_cast<std::size_t>(component_count(out.property));
    out.values = read_numbers(document, index_member(document, sampler, "output", accessors, "accessors", name),
                              components, name + ".output");
    const std::size_t keys = out.times.size();
    out.interpolation =
        read_interpolation(document, sampler, out.values.size() == 3 * keys * components, name, warnings);
    const std::size_t needed = keys * (out.interpolation == Interpolation::cubic_spline ? 3 : 1);
    if (out.values.size() != needed * components) {
        fail(document, name + ".output",
             "has " + std::to_string(out.values.size() / components) + " values where " + std::to_string(needed) +
                 " are needed");
    }
    if (const std::string problem = problem_of(out); !problem.empty()) {
        warn(document, warnings, name, problem + "; left out");
        return std::nullopt;
    }
    repair_times(document, out, name + ".input", warnings);
    return out;
}

}  // namespace diptych::core::gltf
