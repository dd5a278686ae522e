#include "gltf/write.h"

#include "error.h"
#include "gltf/encode_image.h"
#include "gltf/json_animation.h"
#include "gltf/write_file.h"
#include "gltf/written_document.h"
#include "image/atomic_file.h"

#include <algorithm>
#include <limits>
#include <span>
#include <string_view>

namespace diptych::core {
namespace {

using gltf::Json;
using gltf::JsonList;
using gltf::WrittenDocument;

Json add_primitive(WrittenDocument& document, const Primitive& primitive) {
    Json attributes = {{"POSITION", gltf::add_attribute(document, primitive.positions, true)}};
    if (!primitive.normals.empty()) {
        attributes["NORMAL"] = gltf::add_attribute(document, primitive.normals, false);
    }
    if (!primitive.tangents.empty()) {
        attributes["TANGENT"] = gltf::add_attribute(document, primitive.tangents, false);
    }
    for (std::size_t set = 0; set < primitive.uvs.size(); ++set) {
        if (!primitive.uvs[set].empty()) {
            attributes["TEXCOORD_" + std::to_string(set)] = gltf::add_attribute(document, primitive.uvs[set], false);
        }
    }
    if (!primitive.colors.empty()) {
        attributes["COLOR_0"] = gltf::add_attribute(document, primitive.colors, false);
    }
    Json out = {{"attributes", attributes},
                {"indices", gltf::add_indices(document, primitive.triangles, primitive.positions.size())}};
    if (primitive.material != none) {
        out["material"] = primitive.material;
    }
    return out;
}

void add_mesh(WrittenDocument& document, const Mesh& mesh, const std::string& file) {
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

void add_texture(WrittenDocument& document, const Texture& texture) {
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

void add_root(WrittenDocument& document, const Json& node) {
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

void add_nodes(WrittenDocument& document, const Scene& scene, const std::string& file) {
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
        return gltf::add_numbers(document, numbers, components, with_bounds);
    };
    for (const Animation& animation : scene.animations) {
        document.animations.add(gltf::json_animation(animation, first, add_accessor, document.extensions));
    }
}

std::string_view view_of(const std::vector<std::uint8_t>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void add_image(WrittenDocument& document, const TextureImage& image, const std::filesystem::path& path, bool binary,
               FilesTogether& files) {
    const std::vector<std::uint8_t> png = gltf::encode_image(image);
    const std::string name = image.name.empty() ? std::to_string(document.images.size) : image.name;
    if (binary) {
        const int view = gltf::add_view(document, png.data(), png.size(), gltf::no_target);
        document.images.add({{"name", name}, {"mimeType", "image/png"}, {"bufferView", view}});
    } else {
        const std::string file = path.stem().string() + "-" + gltf::file_part(name) + ".png";
        files.add(path.parent_path() / file, {view_of(png)});
        document.images.add({{"name", name}, {"uri", gltf::encoded_uri(file)}});
    }
}

std::string document_text(const WrittenDocument& document, const Scene& scene, const std::string& bin_uri) {
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
void write_glb(const std::filesystem::path& path, WrittenDocument& document, std::string json, FilesTogether& files) {
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
    files.add(path, {header, json, bin_header, {document.bytes.data(), document.bytes.size()}});
}

}  // namespace

void write_gltf(const Scene& scene, const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    const bool binary = extension == ".glb";
    if (!binary && extension != ".gltf") {
        throw Error(path.string() + ": a glTF file ends in .gltf or .glb");
    }

    WrittenDocument document;
    FilesTogether files;
    for (const TextureImage& image : scene.images) {
        add_image(document, image, path, binary, files);
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
        write_glb(path, document, document_text(document, scene, ""), files);
    } else {
        const std::string bin = path.stem().string() + ".bin";
        const std::string_view bytes(document.bytes.data(), document.bytes.size());
        if (!bytes.empty()) {
            files.add(path.parent_path() / bin, {bytes});
        }
        files.add(path, {document_text(document, scene, gltf::encoded_uri(bin))});
    }
    files.publish();
}

}  // namespace diptych::core
