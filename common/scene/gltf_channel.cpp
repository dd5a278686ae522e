#include "scene/gltf_channel.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "scene/gltf_accessor.h"

namespace diptych::gltf {
namespace {

using Json = nlohmann::json;

const Json* member(const Json& object, const char* key) {
    const auto found = object.is_object() ? object.find(key) : object.end();
    return found == object.end() ? nullptr : &*found;
}

int index_member(const Document& document, const Json& object, const char* key, std::size_t size, const char* table,
                 const std::string& name) {
    const Json* value = member(object, key);
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
std::optional<Target> pointer_target(Document& document, const Json& target, const std::string& object) {
    const Json* extensions = member(target, "extensions");
    const Json* extension = extensions != nullptr ? member(*extensions, "KHR_animation_pointer") : nullptr;
    const Json* pointer = extension != nullptr ? member(*extension, "pointer") : nullptr;
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

std::optional<Target> node_target(Document& document, const Json& target, const std::string& path,
                                  const std::string& object) {
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
        fail(document, object + ".target",
             "nodes[" + std::to_string(node) + "] has a matrix, which cannot be animated");
    }
    return Target{property, node};
}

std::optional<Target> read_target(Document& document, const Json& channel, const std::string& object) {
    const Json* target = member(channel, "target");
    const Json* path = target != nullptr ? member(*target, "path") : nullptr;
    if (path == nullptr || !path->is_string()) {
        fail(document, object + ".target.path", "is missing");
    }
    const std::string text = path->get<std::string>();
    return text == "pointer" ? pointer_target(document, *target, object) : node_target(document, *target, text, object);
}

Interpolation read_interpolation(const Document& document, const Json& sampler, const std::string& object) {
    const Json* value = member(sampler, "interpolation");
    if (value == nullptr || *value == "LINEAR") {
        return Interpolation::linear;
    }
    if (*value == "STEP") {
        return Interpolation::step;
    }
    if (*value == "CUBICSPLINE") {
        return Interpolation::cubic_spline;
    }
    fail(document, object + ".interpolation", "is " + value->dump() + ", not STEP, LINEAR or CUBICSPLINE");
}

std::vector<float> read_times(const Document& document, int accessor, const std::string& object) {
    if (find_accessor(document, accessor, object).componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
        fail(document, object, "holds times that are no floats");
    }
    std::vector<float> times = read_numbers(document, accessor, 1, object);
    if (times.empty()) {
        fail(document, object, "has no keys");
    }
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (!std::isfinite(times[i]) || times[i] < 0 || (i > 0 && times[i] <= times[i - 1])) {
            fail(document, object,
                 "time " + std::to_string(i) + " is " + std::to_string(times[i]) + "; times must rise from 0");
        }
    }
    return times;
}

std::vector<float> read_values(const Document& document, int accessor, const Channel& channel,
                               const std::string& object) {
    const auto components = static_cast<std::size_t>(component_count(channel.property));
    std::vector<float> values = read_numbers(document, accessor, components, object);
    const bool spline = channel.interpolation == Interpolation::cubic_spline;
    const std::size_t groups = channel.times.size() * (spline ? 3 : 1);
    if (values.size() != groups * components) {
        fail(document, object,
             "has " + std::to_string(values.size() / components) + " values where " + std::to_string(groups) +
                 " are needed");
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i])) {
            fail(document, object, "value " + std::to_string(i / components) + " is not finite");
        }
    }
    for (std::size_t key = 0; key < channel.times.size() && channel.property == AnimatedProperty::rotation; ++key) {
        const float* q = &values[4 * (spline ? 3 * key + 1 : key)];
        if (q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0) {
            fail(document, object, "value " + std::to_string(key) + " is no rotation");
        }
    }
    return values;
}

}  // namespace

std::optional<Channel> read_channel(Document& document, const Json& animation, const Json& channel,
                                    const std::string& object) {
    const Json* samplers = member(animation, "samplers");
    const int index =
        index_member(document, channel, "sampler", samplers != nullptr ? samplers->size() : 0, "samplers", object);
    const std::optional<Target> target = read_target(document, channel, object);
    if (!target) {
        return std::nullopt;
    }
    if (!samplers->is_array()) {
        fail(document, object, "the animation's samplers are no array");
    }
    const Json& sampler = (*samplers)[static_cast<std::size_t>(index)];
    const std::string name = object + ".samplers[" + std::to_string(index) + "]";
    const std::size_t accessors = document.model.accessors.size();
    Channel out;
    out.property = target->property;
    out.target = target->index;
    out.interpolation = read_interpolation(document, sampler, name);
    out.times =
        read_times(document, index_member(document, sampler, "input", accessors, "accessors", name), name + ".input");
    out.values = read_values(document, index_member(document, sampler, "output", accessors, "accessors", name), out,
                             name + ".output");
    return out;
}

}  // namespace diptych::gltf
