#include "gltf/write.h"

#include "error.h"
#include "gltf/encode_image.h"
#include "gltf/json_animation.h"
#include "gltf/write_file.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>
#include <unordered_map>

namespace diptych::core {
namespace {

using gltf::Json;

/// A top-level array, kept as text, one element a line: a million nodes cost their characters, and files diff by
/// object.
struct JsonList {
    std::string text;
    int size = 0;

    int add(const Json& element) {
        text += size == 0 ? "\n  " : ",\n  ";
        text += element.dump();
        return size++;
    }
};

/// An accessor already written, for another that would hold the same.
struct StoredArray {
    int accessor;
    std::size_t offset, size;
    std::string kind;
};

struct Document {
    std::vector<char> bytes;
    std::unordered_multimap<std::size_t, StoredArray> arrays;  // by the hash of their bytes
    JsonList accessors, views, images, samplers, textures, materials, meshes, cameras, lights, nodes, animations;
    std::string root_nodes;  // comma-separated indices
    std::set<std::string> extensions;
};

enum ViewTarget { no_target = 0, vertex_target = 34962, index_target = 34963 };
enum ComponentType { type_uint16 = 5123, type_uint32 = 5125, type_float = 5126 };

int add_view(Document& document, const void* data, std::size_t size, ViewTarget target) {
    auto& bytes = document.bytes;
    bytes.resize((bytes.size() + 3) / 4 * 4);
    Json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}};
    if (target != no_target) {
        view["target"] = int(target);
    }
    const auto* first = static_cast<const char*>(data);
    bytes.insert(bytes.end(), first, first + size);
    return document.views.add(view);
}

/// The accessor of an array; arrays of one content and kind share one. `accessor` lacks only its view.
int add_array(Document& document, const void* data, std::size_t size, ViewTarget target, const Json& accessor) {
    const std::string_view content(static_cast<const char*>(data), size);
    const std::string kind = accessor.dump();
    const std::size_t hash = std::hash<std::string_view>{}(content);
    const auto [first, last] = document.arrays.equal_range(hash);
    for (auto it = first; it != last; ++it) {
        const StoredArray& stored = it->second;
        if (stored.kind == kind && stored.size == size &&
            std::memcmp(document.bytes.data() + stored.offset, data, size) == 0) {
            return stored.accessor;
        }
    }
    Json out = {{"bufferView", add_view(document, data, size, target)}};
    out.update(accessor);
    const int index = document.accessors.add(out);
    document.arrays.emplace(hash, StoredArray{index, document.bytes.size() - size, size, kind});
    return index;
}

template <typename Vector>
int add_attribute(Document& document, const std::vector<Vector>& values, bool with_bounds) {
    Json accessor = {{"componentType", int(type_float)},
                     {"count", values.size()},
                     {"type", "VEC" + std::to_string(Vector::length())}};
    if (with_bounds) {
        Vector low = values.front(), high = values.front();
        for (const Vector& value : values) {
            low = glm::min(low, value);
            high = glm::max(high, value);
        }
        accessor["min"] = gltf::json_vector(low);
        accessor["max"] = gltf::json_vector(high);
    }
    return add_array(document, values.data(), values.size() * sizeof(Vector), vertex_target, accessor);
}

int add_numbers(Document& document, const std::vector<float>& numbers, int components, bool with_bounds) {
    const std::string type = components == 1 ? "SCALAR" : "VEC" + std::to_string(components);
    Json accessor = {
        {"componentType", int(type_float)}, {"count", numbers.size() / std::size_t(components)}, {"type", type}};
    if (with_bounds) {
        const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
        accessor["min"] = Json::array({gltf::decimal(*low)});
        accessor["max"] = Json::array({gltf::decimal(*high)});
    }
    return add_array(document, numbers.data(), numbers.size() * sizeof(float), no_target, accessor);
}

int add_indices(Document& document, const std::vector<glm::uvec3>& triangles, std::size_t vertices) {
    const std::size_t count = 3 * triangles.size();
    const bool is_short = vertices <= 65535;  // 65535 itself would restart a strip
    const Json accessor = {
        {"componentType", int(is_short ? type_uint16 : type_uint32)}, {"count", count}, {"type", "SCALAR"}};
    if (!is_short) {
        return add_array(document, triangles.data(), 4 * count, index_target, accessor);
    }
    std::vector<std::uint16_t> indices;
    indices.reserve(count);
    for (const glm::uvec3& t : triangles) {
        for (int i = 0; i < 3; ++i) {
            indices.push_back(std::uint16_t(t[i]));
        }
    }
    return add_array(document, indices.data(), 2 * count, index_target, accessor);
}

Json add_primitive(Document& document, const Primitive& primitive) {
    Json attributes = {{"POSITION", add_attribute(document, primitive.positions, true)}};
    if (!primitive.normals.empty()) {
        attributes["NORMAL"] = add_attribute(document, primitive.normals, false);
    }
    if (!primitive.tangents.empty()) {
        attributes["TANGENT"] = add_attribute(document, primitive.tangents, false);
    }
    for (std::size_t set = 0; set < primitive.uvs.size(); ++set) {
        if (!primitive.uvs[set].empty()) {
            attributes["TEXCOORD_" + std::to_string(set)] = add_attribute(document, primitive.uvs[set], false);
        }
    }
    if (!primitive.colors.empty()) {
        attributes["COLOR_0"] = add_attribute(document, primitive.colors, false);
    }
    Json out = {{"attributes", attributes},
                {"indices", add_indices(document, primitive.triangles, primitive.positions.size())}};
    if (primitive.material != none) {
        out["material"] = primitive.material;
    }
    return out;
}

void add_mesh(Document& document, const Mesh& mesh, const std::string& file) {
    Json out;
    if (!mesh.name.empty()) {
        out["name"] = mesh.name;
    }
    Json primitives = Json::array();
    for (const Primitive& primitive : mesh.primitives) {
        if (primitive.triangles.empty() || primitive.positions.empty()) {
            throw Error(file + ": mesh '" + mesh.name + "': a primitive has no triangles");
        }
        primitives.push_back(add_primitive(document, primitive));
    }
    if (primitives.empty()) {
        throw Error(file + ": mesh '" + mesh.name + "': it has no primitives");
    }
    out["primitives"] = primitives;
    document.meshes.add(out);
}

void add_texture(Document& document, const Texture& texture) {
    const auto wrap = [](Wrap mode) { return mode == Wrap::repeat ? 10497 : mode == Wrap::clamp ? 33071 : 33648; };
    const int filter = texture.filter == Filter::linear ? 9729 : 9728;
    const int sampler = document.samplers.add({{"magFilter", filter},
                                               {"minFilter", filter},
                                               {"wrapS", wrap(texture.wrap_u)},
                                               {"wrapT", wrap(texture.wrap_v)}});
    Json out;
    if (!texture.name.empty()) {
        out["name"] = texture.name;
    }
    out["sampler"] = sampler;
    if (texture.image != none) {
        out["source"] = texture.image;
    }
    document.textures.add(out);
}

Json named_node(const std::string& name, const glm::dmat4& to_world) {
    Json node;
    if (!name.empty()) {
        node["name"] = name;
    }
    gltf::place(node, to_world);
    return node;
}

void add_root(Document& document, const Json& node) {
    const int index = document.nodes.add(node);
    document.root_nodes += (document.root_nodes.empty() ? "" : ",") + std::to_string(index);
}

/// What moves, and what carries it: nodes with all that hangs in them, after the still ones.
struct MovingNodes {
    std::vector<Json> nodes;
    const std::string& file;

    /// Where to put `member` of a thing that hangs in `node`.
    Json& slot(int node, const char* member) {
        Json& json = nodes.at(std::size_t(node));
        if (json.contains(member)) {
            throw Error(file + ": node '" + json.value("name", "") + "': a node holds one " + member + " at most");
        }
        return json[member];
    }
};

void add_nodes(Document& document, const Scene& scene, const std::string& file) {
    MovingNodes moving{{}, file};
    for (const Node& node : scene.nodes) {
        moving.nodes.push_back(gltf::json_node(node));
    }
    for (const Camera& camera : scene.cameras) {
        const int index = document.cameras.add(gltf::json_camera(camera));
        if (camera.node != none) {
            moving.slot(camera.node, "camera") = index;
            continue;
        }
        Json node = named_node(camera.name, camera.camera_to_world);
        node["camera"] = index;
        add_root(document, node);
    }
    for (const PunctualLight& light : scene.lights) {
        const Json reference = {{"KHR_lights_punctual", {{"light", document.lights.add(gltf::json_light(light))}}}};
        document.extensions.insert("KHR_lights_punctual");
        if (light.node != none) {
            moving.slot(light.node, "extensions") = reference;
            continue;
        }
        Json node = named_node(light.name, light.light_to_world);
        node["extensions"] = reference;
        add_root(document, node);
    }
    for (const Instance& instance : scene.instances) {
        if (instance.node != none) {
            moving.slot(instance.node, "mesh") = instance.mesh;
            continue;
        }
        Json node = named_node(instance.name, instance.object_to_world);
        if (instance.mesh != none) {
            node["mesh"] = instance.mesh;
        }
        add_root(document, node);
    }
    const int first = document.nodes.size;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].parent != none) {
            moving.nodes.at(std::size_t(scene.nodes[i].parent))["children"].push_back(first + int(i));
        }
    }
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].parent == none) {
            add_root(document, moving.nodes[i]);
        } else {
            document.nodes.add(moving.nodes[i]);
        }
    }
    const gltf::AddAccessor add_accessor = [&](const std::vector<float>& numbers, int components, bool with_bounds) {
        return add_numbers(document, numbers, components, with_bounds);
    };
    for (const Animation& animation : scene.animations) {
        document.animations.add(gltf::json_animation(animation, first, add_accessor, document.extensions));
    }
}

std::string_view view_of(const std::vector<std::uint8_t>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void add_image(Document& document, const TextureImage& image, const std::filesystem::path& path, bool binary) {
    const std::vector<std::uint8_t> png = gltf::encode_image(image);
    const std::string name = image.name.empty() ? std::to_string(document.images.size) : image.name;
    if (binary) {
        const int view = add_view(document, png.data(), png.size(), no_target);
        document.images.add({{"name", name}, {"mimeType", "image/png"}, {"bufferView", view}});
    } else {
        const std::string file = path.stem().string() + "-" + gltf::file_part(name) + ".png";
        gltf::write_whole(path.parent_path() / file, {view_of(png)});
        document.images.add({{"name", name}, {"uri", gltf::encoded_uri(file)}});
    }
}

std::string document_text(const Document& document, const Scene& scene, const std::string& bin_uri) {
    std::string out = "{\n\"asset\": " + Json{{"version", "2.0"}, {"generator", "Diptych"}}.dump();
    if (!document.extensions.empty()) {
        out += ",\n\"extensionsUsed\": " + Json(document.extensions).dump();
    }
    if (document.lights.size != 0) {
        out += ",\n\"extensions\": {\"KHR_lights_punctual\": {\"lights\": [" + document.lights.text + "\n]}}";
    }
    Json root;
    if (!scene.name.empty()) {
        root["name"] = scene.name;
    }
    if (scene.environment.kind == Environment::Kind::constant) {
        root["extras"]["diptych"]["environment"] = gltf::json_vector(scene.environment.scale);
    }
    std::string root_text = root.is_null() ? "{" : root.dump();
    if (!root.is_null()) {
        root_text.back() = ',';
    }
    if (document.nodes.size == 0 && !root.is_null()) {
        root_text.back() = '}';
    } else if (document.nodes.size == 0) {
        root_text += "}";
    } else {
        root_text += "\"nodes\":[" + document.root_nodes + "]}";
    }
    out += ",\n\"scene\": 0,\n\"scenes\": [" + root_text + "]";
    const std::pair<const char*, const JsonList*> lists[] = {
        {"animations", &document.animations}, {"nodes", &document.nodes},         {"cameras", &document.cameras},
        {"meshes", &document.meshes},         {"materials", &document.materials}, {"textures", &document.textures},
        {"samplers", &document.samplers},     {"images", &document.images},       {"accessors", &document.accessors},
        {"bufferViews", &document.views}};
    for (const auto& [name, list] : lists) {
        if (list->size != 0) {
            out += ",\n\"" + std::string(name) + "\": [" + list->text + "\n]";
        }
    }
    if (!document.bytes.empty()) {
        Json buffer;
        if (!bin_uri.empty()) {
            buffer["uri"] = bin_uri;
        }
        buffer["byteLength"] = document.bytes.size();
        out += ",\n\"buffers\": [" + buffer.dump() + "]";
    }
    return out + "\n}\n";
}

/// The container of glTF 2.0, section 4.4: a header and two chunks, little-endian, each padded to four bytes.
void write_glb(const std::filesystem::path& path, Document& document, std::string json) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    document.bytes.resize((document.bytes.size() + 3) / 4 * 4);
    const std::uint64_t bin_part = document.bytes.empty() ? 0 : 8 + document.bytes.size();
    const std::uint64_t total = 12 + 8 + json.size() + bin_part;
    if (total > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(path.string() + ": more than 4 GiB do not fit a .glb; write a .gltf");
    }
    const auto words = [](std::initializer_list<std::uint64_t> values) {
        std::string out;
        for (const std::uint64_t value : values) {
            for (unsigned shift = 0; shift < 32; shift += 8) {
                out += char(value >> shift & 0xffU);
            }
        }
        return out;
    };
    const std::string header = words({0x46546c67, 2, total, json.size(), 0x4e4f534a});
    const std::string bin_header = document.bytes.empty() ? "" : words({document.bytes.size(), 0x004e4942});
    gltf::write_whole(path, {header, json, bin_header, {document.bytes.data(), document.bytes.size()}});
}

}  // namespace

void write_gltf(const Scene& scene, const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    const bool binary = extension == ".glb";
    if (!binary && extension != ".gltf") {
        throw Error(path.string() + ": a glTF file ends in .gltf or .glb");
    }

    Document document;
    for (const TextureImage& image : scene.images) {
        add_image(document, image, path, binary);
    }
    for (const Texture& texture : scene.textures) {
        add_texture(document, texture);
    }
    for (const Material& material : scene.materials) {
        document.materials.add(gltf::json_material(material, document.extensions));
    }
    for (const Mesh& mesh : scene.meshes) {
        add_mesh(document, mesh, path.string());
    }
    add_nodes(document, scene, path.string());

    if (binary) {
        write_glb(path, document, document_text(document, scene, ""));
        return;
    }
    const std::string bin = path.stem().string() + ".bin";
    if (!document.bytes.empty()) {
        gltf::write_whole(path.parent_path() / bin, {std::string_view(document.bytes.data(), document.bytes.size())});
    }
    const std::string json = document_text(document, scene, gltf::encoded_uri(bin));
    gltf::write_whole(path, {json});
}

}  // namespace diptych::core
