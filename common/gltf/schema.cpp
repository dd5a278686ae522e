#include "gltf/schema.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>

#include "gltf/parse.h"

namespace diptych::core::gltf {
namespace {

using ParsedJson = nlohmann::json;

enum class Type { index, size, integer, number, boolean, string, element_type, array, object };

enum class Presence { optional, required };

/// Where a member stands: names with slashes between them. name[] stands for every element of an array, name[3] for
/// those of an array of three, name{} for every member of an object.
struct Member {
    const char* path;
    Type type;
    Presence presence = Presence::optional;  // where the object that holds the member is there
};

// What of a texture reference is read.
#define TEXTURE(path)                                                           \
    {path "/index", Type::index, Presence::required}, {path "/texCoord", Type::index},              \
        {path "/extensions/KHR_texture_transform/offset[2]", Type::number},      \
        {path "/extensions/KHR_texture_transform/scale[2]", Type::number},       \
        {path "/extensions/KHR_texture_transform/rotation", Type::number},      \
        {path "/extensions/KHR_texture_transform/texCoord", Type::index}
#define MATERIAL_EXTENSION(name) "materials[]/extensions/KHR_materials_" name
#define LIGHT "extensions/KHR_lights_punctual/lights[]"

constexpr Member members[] = {
    {"asset/minVersion", Type::string},
    {"extensionsUsed[]", Type::string},
    {"extensionsRequired[]", Type::string},
    {"scene", Type::index},
    {"scenes[]/name", Type::string},
    {"scenes[]/nodes[]", Type::index},
    {"nodes[]/name", Type::string},
    {"nodes[]/children[]", Type::index},
    {"nodes[]/mesh", Type::index},
    {"nodes[]/skin", Type::index},
    {"nodes[]/camera", Type::index},
    {"nodes[]/matrix[]", Type::number},
    {"nodes[]/translation[]", Type::number},
    {"nodes[]/rotation[]", Type::number},
    {"nodes[]/scale[]", Type::number},
    {"nodes[]/weights[]", Type::number},
    {"nodes[]/extensions/KHR_lights_punctual/light", Type::index},
    {"meshes[]/name", Type::string},
    {"meshes[]/weights[]", Type::number},
    {"meshes[]/primitives[]/attributes", Type::object, Presence::required},
    {"meshes[]/primitives[]/attributes{}", Type::index},
    {"meshes[]/primitives[]/targets[]{}", Type::index},
    {"meshes[]/primitives[]/indices", Type::index},
    {"meshes[]/primitives[]/material", Type::index},
    {"meshes[]/primitives[]/mode", Type::integer},
    {"skins[]/name", Type::string},
    {"skins[]/joints", Type::array, Presence::required},
    {"skins[]/joints[]", Type::index},
    {"skins[]/inverseBindMatrices", Type::index},
    {"cameras[]/name", Type::string},
    {"cameras[]/type", Type::string, Presence::required},
    {"cameras[]/perspective/yfov", Type::number, Presence::required},
    {"cameras[]/perspective/aspectRatio", Type::number},
    {"cameras[]/orthographic/xmag", Type::number, Presence::required},
    {"cameras[]/orthographic/ymag", Type::number, Presence::required},
    {"buffers[]/byteLength", Type::size, Presence::required},
    {"buffers[]/uri", Type::string},
    {"bufferViews[]/buffer", Type::index, Presence::required},
    {"bufferViews[]/byteOffset", Type::size},
    {"bufferViews[]/byteLength", Type::size, Presence::required},
    {"bufferViews[]/byteStride", Type::size},
    {"accessors[]/bufferView", Type::index},
    {"accessors[]/byteOffset", Type::size},
    {"accessors[]/count", Type::size, Presence::required},
    {"accessors[]/componentType", Type::integer, Presence::required},
    {"accessors[]/type", Type::element_type, Presence::required},
    {"accessors[]/normalized", Type::boolean},
    {"accessors[]/sparse/indices", Type::object, Presence::required},
    {"accessors[]/sparse/values", Type::object, Presence::required},
    {"accessors[]/sparse/count", Type::size, Presence::required},
    {"accessors[]/sparse/indices/bufferView", Type::index, Presence::required},
    {"accessors[]/sparse/indices/byteOffset", Type::size},
    {"accessors[]/sparse/indices/componentType", Type::integer, Presence::required},
    {"accessors[]/sparse/values/bufferView", Type::index, Presence::required},
    {"accessors[]/sparse/values/byteOffset", Type::size},
    {"images[]/name", Type::string},
    {"images[]/uri", Type::string},
    {"images[]/bufferView", Type::index},
    {"samplers[]/name", Type::string},
    {"samplers[]/magFilter", Type::integer},
    {"samplers[]/wrapS", Type::integer},
    {"samplers[]/wrapT", Type::integer},
    {"textures[]/name", Type::string},
    {"textures[]/source", Type::index},
    {"textures[]/sampler", Type::index},
    {"textures[]/extensions/EXT_texture_webp/source", Type::index},
    {"textures[]/extensions/KHR_texture_basisu/source", Type::index},
    {"materials[]/name", Type::string},
    {"materials[]/alphaMode", Type::string},
    {"materials[]/alphaCutoff", Type::number},
    {"materials[]/doubleSided", Type::boolean},
    {"materials[]/emissiveFactor[3]", Type::number},
    {"materials[]/pbrMetallicRoughness/baseColorFactor[4]", Type::number},
    {"materials[]/pbrMetallicRoughness/metallicFactor", Type::number},
    {"materials[]/pbrMetallicRoughness/roughnessFactor", Type::number},
    TEXTURE("materials[]/pbrMetallicRoughness/baseColorTexture"),
    TEXTURE("materials[]/pbrMetallicRoughness/metallicRoughnessTexture"),
    TEXTURE("materials[]/emissiveTexture"),
    TEXTURE("materials[]/normalTexture"),
    {"materials[]/normalTexture/scale", Type::number},
    {MATERIAL_EXTENSION("emissive_strength") "/emissiveStrength", Type::number},
    {MATERIAL_EXTENSION("ior") "/ior", Type::number},
    {MATERIAL_EXTENSION("specular") "/specularFactor", Type::number},
    {MATERIAL_EXTENSION("specular") "/specularColorFactor[3]", Type::number},
    TEXTURE(MATERIAL_EXTENSION("specular") "/specularTexture"),
    TEXTURE(MATERIAL_EXTENSION("specular") "/specularColorTexture"),
    {MATERIAL_EXTENSION("unlit"), Type::object},
    {LIGHT "/name", Type::string},
    {LIGHT "/type", Type::string, Presence::required},
    {LIGHT "/color[]", Type::number},
    {LIGHT "/intensity", Type::number},
    {LIGHT "/spot/innerConeAngle", Type::number},
    {LIGHT "/spot/outerConeAngle", Type::number},
    {"animations[]/name", Type::string},
    {"animations[]/channels[]/sampler", Type::index},
    {"animations[]/channels[]/target/node", Type::index},
    {"animations[]/channels[]/target/path", Type::string},
    {"animations[]/channels[]/target/extensions/KHR_animation_pointer/pointer", Type::string},
    {"animations[]/samplers[]/input", Type::index},
    {"animations[]/samplers[]/output", Type::index},
};

#undef TEXTURE
#undef MATERIAL_EXTENSION
#undef LIGHT

bool is_element_type(const std::string& word) {
    constexpr const char* types[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    return std::find(std::begin(types), std::end(types), word) != std::end(types);
}

// What is wrong with the value; empty where nothing is.
const char* problem_of(const ParsedJson& value, Type type) {
    constexpr std::int64_t last_index = std::numeric_limits<std::int32_t>::max();
    constexpr double largest = std::numeric_limits<float>::max();
    const bool whole = value.is_number_integer();
    switch (type) {
    case Type::index:
        return value.is_number_unsigned() && value.get<std::uint64_t>() <= last_index ? "" : "is no index";
    case Type::size:
        return value.is_number_unsigned() ? "" : "is no whole number from 0 up";
    case Type::integer:
        return whole && std::abs(value.get<double>()) <= last_index ? "" : "is no integer";
    case Type::number:
        if (!value.is_number()) {
            return "is no number";
        }
        return std::abs(value.get<double>()) <= largest ? "" : "is out of range";
    case Type::boolean:
        return value.is_boolean() ? "" : "is neither true nor false";
    case Type::string:
        return value.is_string() ? "" : "is no string";
    case Type::element_type:
        return value.is_string() && is_element_type(value.get_ref<const std::string&>()) ? "" : "is no type of element";
    case Type::array:
        return value.is_array() ? "" : "is no array";
    case Type::object:
        return value.is_object() ? "" : "is no object";
    }
    return "";
}

/// A value's place in the document, as a list from the value up to the root. Its text is made only for a message.
struct Place {
    const Place* parent = nullptr;
    std::string_view name = {};  // empty: the element `index` of an array
    std::size_t index = 0;

    std::string pointer() const {
        return parent == nullptr ? "" : parent->pointer() + pointer_part(name.empty() ? std::to_string(index) : std::string(name));
    }
};

class Checker {
public:
    Checker(const Document& document, const Member& member) : document_(document), member_(member) {}

    /// Checks what lies at `path` from `value` on.
    void check(ParsedJson& value, std::string_view path, const Place& place) const {
        if (path.empty()) {
            check_value(value, place);
        } else if (path.front() == '[') {
            check_elements(value, path, place);
        } else if (path.front() == '{') {
            require(value.is_object(), value, "is no object", place);
            for (auto& [name, member] : value.get_ref<ParsedJson::object_t&>()) {
                check(member, path.substr(2), {&place, name});
            }
        } else {
            check_member(value, path.substr(path.front() == '/' ? 1 : 0), place);
        }
    }

private:
    void check_elements(ParsedJson& value, std::string_view path, const Place& place) const {
        require(value.is_array(), value, "is no array", place);
        const std::size_t end = path.find(']');
        const std::string size(path.substr(1, end - 1));
        if (!size.empty() && std::to_string(value.size()) != size) {
            require(false, value, "has " + std::to_string(value.size()) + " elements instead of " + size, place);
        }
        std::size_t index = 0;
        for (ParsedJson& element : value) {
            check(element, path.substr(end + 1), {&place, {}, index++});
        }
    }

    void check_member(ParsedJson& value, std::string_view path, const Place& place) const {
        require(value.is_object(), value, "is no object", place);
        const std::size_t end = std::min(path.find_first_of("/[{"), path.size());
        const std::string name(path.substr(0, end));
        const auto member = value.find(name);
        if (member != value.end()) {
            check(*member, path.substr(end), {&place, name});
        } else if (end == path.size() && member_.presence == Presence::required) {
            fail(document_, place.pointer(), "lacks '" + name + "'");
        }
    }

    void check_value(ParsedJson& value, const Place& place) const {
        const Type type = member_.type;
        const bool integral = type == Type::index || type == Type::size || type == Type::integer;
        if (integral && value.is_number_float()) {
            const double number = value.get<double>();
            if (number == std::floor(number) && std::abs(number) < 9007199254740992.0) {
                value = number < 0 ? ParsedJson(static_cast<std::int64_t>(number)) : ParsedJson(static_cast<std::uint64_t>(number));
            }
        }
        const char* problem = problem_of(value, type);
        require(*problem == 0, value, problem, place);
    }

    void require(bool holds, const ParsedJson& value, std::string_view problem, const Place& place) const {
        if (!holds) {
            const std::string text = value.dump(-1, ' ', false, ParsedJson::error_handler_t::replace);
            const std::string pointer = place.pointer();
            fail(document_, pointer.empty() ? "JSON" : pointer,
                 std::string(problem) + ": " + (text.size() > 40 ? text.substr(0, 40) + "…" : text));
        }
    }

    const Document& document_;
    const Member& member_;
};

}  // namespace

void check_types(const Document& document, ParsedJson& root) {
    for (const Member& member : members) {
        Checker(document, member).check(root, member.path, Place{});
    }
}

}  // namespace diptych::core::gltf
