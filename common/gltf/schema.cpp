#include "gltf/schema.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "gltf/parse.h"

namespace diptych::core::gltf {
namespace {

using ParsedJson = nlohmann::json;

enum class Type { index, size, integer, number, boolean, string, object };

/// Where a member stands: names with slashes between them. name[] stands for every element of an array, name{} for
/// every member of an object.
struct Member {
    const char* path;
    Type type;
};

// What of a texture reference is read.
#define TEXTURE(path)                                                           \
    {path "/index", Type::index}, {path "/texCoord", Type::index},              \
        {path "/extensions/KHR_texture_transform/offset[]", Type::number},      \
        {path "/extensions/KHR_texture_transform/scale[]", Type::number},       \
        {path "/extensions/KHR_texture_transform/rotation", Type::number},      \
        {path "/extensions/KHR_texture_transform/texCoord", Type::index}
#define MATERIAL_EXTENSION(name) "materials[]/extensions/KHR_materials_" name
#define LIGHT "extensions/KHR_lights_punctual/lights[]"

constexpr Member members[] = {
    {"scene", Type::index},
    {"scenes[]/nodes[]", Type::index},
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
    {"meshes[]/weights[]", Type::number},
    {"meshes[]/primitives[]/attributes{}", Type::index},
    {"meshes[]/primitives[]/targets[]{}", Type::index},
    {"meshes[]/primitives[]/indices", Type::index},
    {"meshes[]/primitives[]/material", Type::index},
    {"meshes[]/primitives[]/mode", Type::integer},
    {"skins[]/joints[]", Type::index},
    {"skins[]/inverseBindMatrices", Type::index},
    {"cameras[]/type", Type::string},
    {"cameras[]/perspective/yfov", Type::number},
    {"cameras[]/perspective/aspectRatio", Type::number},
    {"cameras[]/orthographic/xmag", Type::number},
    {"cameras[]/orthographic/ymag", Type::number},
    {"buffers[]/byteLength", Type::size},
    {"buffers[]/uri", Type::string},
    {"bufferViews[]/buffer", Type::index},
    {"bufferViews[]/byteOffset", Type::size},
    {"bufferViews[]/byteLength", Type::size},
    {"bufferViews[]/byteStride", Type::size},
    {"accessors[]/bufferView", Type::index},
    {"accessors[]/byteOffset", Type::size},
    {"accessors[]/count", Type::size},
    {"accessors[]/componentType", Type::integer},
    {"accessors[]/type", Type::string},
    {"accessors[]/normalized", Type::boolean},
    {"accessors[]/sparse/count", Type::size},
    {"accessors[]/sparse/indices/bufferView", Type::index},
    {"accessors[]/sparse/indices/byteOffset", Type::size},
    {"accessors[]/sparse/indices/componentType", Type::integer},
    {"accessors[]/sparse/values/bufferView", Type::index},
    {"accessors[]/sparse/values/byteOffset", Type::size},
    {"images[]/uri", Type::string},
    {"images[]/bufferView", Type::index},
    {"samplers[]/magFilter", Type::integer},
    {"samplers[]/wrapS", Type::integer},
    {"samplers[]/wrapT", Type::integer},
    {"textures[]/source", Type::index},
    {"textures[]/sampler", Type::index},
    {"textures[]/extensions/EXT_texture_webp/source", Type::index},
    {"textures[]/extensions/KHR_texture_basisu/source", Type::index},
    {"materials[]/alphaMode", Type::string},
    {"materials[]/alphaCutoff", Type::number},
    {"materials[]/doubleSided", Type::boolean},
    {"materials[]/emissiveFactor[]", Type::number},
    {"materials[]/pbrMetallicRoughness/baseColorFactor[]", Type::number},
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
    {MATERIAL_EXTENSION("specular") "/specularColorFactor[]", Type::number},
    TEXTURE(MATERIAL_EXTENSION("specular") "/specularTexture"),
    TEXTURE(MATERIAL_EXTENSION("specular") "/specularColorTexture"),
    {MATERIAL_EXTENSION("unlit"), Type::object},
    {LIGHT "/type", Type::string},
    {LIGHT "/color[]", Type::number},
    {LIGHT "/intensity", Type::number},
    {LIGHT "/spot/innerConeAngle", Type::number},
    {LIGHT "/spot/outerConeAngle", Type::number},
    {"animations[]/channels[]/sampler", Type::index},
    {"animations[]/channels[]/target/node", Type::index},
    {"animations[]/channels[]/target/path", Type::string},
    {"animations[]/samplers[]/input", Type::index},
    {"animations[]/samplers[]/output", Type::index},
};

#undef TEXTURE
#undef MATERIAL_EXTENSION
#undef LIGHT

// What is wrong with the value; empty where nothing is.
std::string problem_of(const ParsedJson& value, Type type) {
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
    case Type::object:
        return value.is_object() ? "" : "is no object";
    }
    return "";
}

class Checker {
public:
    explicit Checker(const Document& document) : document_(document) {}

    /// Checks what lies at `path` from `value` on, which is at `pointer` itself.
    void check(ParsedJson& value, std::string_view path, Type type, const std::string& pointer) const {
        if (path.empty()) {
            check_value(value, type, pointer);
        } else if (path.substr(0, 2) == "[]") {
            require(value.is_array(), value, "is no array", pointer);
            for (std::size_t i = 0; i < value.size(); ++i) {
                check(value[i], path.substr(2), type, pointer + "/" + std::to_string(i));
            }
        } else if (path.substr(0, 2) == "{}") {
            require(value.is_object(), value, "is no object", pointer);
            for (auto& [name, member] : value.items()) {
                check(member, path.substr(2), type, pointer + pointer_part(name));
            }
        } else {
            require(value.is_object(), value, "is no object", pointer);
            path.remove_prefix(path.front() == '/' ? 1 : 0);
            const std::size_t end = std::min(path.find_first_of("/[{"), path.size());
            const std::string name(path.substr(0, end));
            if (const auto member = value.find(name); member != value.end()) {
                check(*member, path.substr(end), type, pointer + "/" + name);
            }
        }
    }

private:
    void check_value(ParsedJson& value, Type type, const std::string& pointer) const {
        const bool integral = type == Type::index || type == Type::size || type == Type::integer;
        if (integral && value.is_number_float()) {
            const double number = value.get<double>();
            if (number == std::floor(number) && std::abs(number) < 9007199254740992.0) {
                value = number < 0 ? ParsedJson(static_cast<std::int64_t>(number)) : ParsedJson(static_cast<std::uint64_t>(number));
            }
        }
        const std::string problem = problem_of(value, type);
        require(problem.empty(), value, problem, pointer);
    }

    void require(bool holds, const ParsedJson& value, const std::string& problem, const std::string& pointer) const {
        if (!holds) {
            const std::string text = value.dump(-1, ' ', false, ParsedJson::error_handler_t::replace);
            fail(document_, pointer, problem + ": " + (text.size() > 40 ? text.substr(0, 40) + "…" : text));
        }
    }

    const Document& document_;
};

}  // namespace

void check_types(const Document& document, ParsedJson& root) {
    const Checker checker(document);
    for (const Member& member : members) {
        checker.check(root, member.path, member.type, "");
    }
}

}  // namespace diptych::core::gltf
