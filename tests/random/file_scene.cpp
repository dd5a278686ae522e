#include "file_scene.h"

#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace diptych::core::tests {

using nlohmann::json;

namespace {

std::string whole(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

template <typename T>
T bytes_at(const std::vector<char>& bytes, std::size_t at) {
    if (at > bytes.size() || bytes.size() - at < sizeof(T)) {
        throw std::out_of_range("an accessor ends beyond its buffer");
    }
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

glm::dmat4 local_matrix(const json& node) {
    glm::dmat4 out(1);
    if (node.contains("matrix")) {
        for (int i = 0; i < 16; ++i) {
            out[i / 4][i % 4] = node.at("matrix").at(std::size_t(i));
        }
        return out;
    }
    const glm::dvec4 q = vector_of<4>(node, "rotation", {0, 0, 0, 1});
    const glm::dvec3 scale = vector_of<3>(node, "scale", {1, 1, 1});
    for (int i = 0; i < 3; ++i) {  // v + 2 q × (q × v + w v)
        glm::dvec3 v(0);
        v[i] = 1;
        const glm::dvec3 axis(q);
        out[i] = glm::dvec4(scale[i] * (v + 2.0 * cross(axis, cross(axis, v) + q.w * v)), 0);
    }
    out[3] = glm::dvec4(vector_of<3>(node, "translation", {0, 0, 0}), 1);
    return out;
}

}  // namespace

FileScene::FileScene(const std::filesystem::path& path) : document_(json::parse(whole(path))) {
    const std::string bin = whole(path.parent_path() / document_.at("buffers").at(0).at("uri"));
    bytes_.assign(bin.begin(), bin.end());
    for (const json& image : document_.value("images", json::array())) {
        images_.push_back(read_raw(path.parent_path() / image.at("uri").get<std::string>(), "", {"A"}).image);
    }
    cameras_.resize(document_.at("cameras").size());
    lights_.resize(document_.value("/extensions/KHR_lights_punctual/lights"_json_pointer, json::array()).size());
    for (const json& root : document_.at("scenes").at(0).at("nodes")) {
        add_node(document_.at("nodes").at(root.get<std::size_t>()), glm::dmat4(1));
    }
}

void FileScene::add_node(const json& node, const glm::dmat4& parent) {
    const glm::dmat4 to_world = parent * local_matrix(node);
    if (node.contains("camera")) {
        cameras_.at(node.at("camera")) = to_world;
    }
    const auto light = "/extensions/KHR_lights_punctual/light"_json_pointer;
    if (node.contains(light)) {
        lights_.at(node.at(light)) = to_world;
    }
    if (node.contains("mesh")) {
        for (const json& primitive : document_.at("meshes").at(node.at("mesh").get<std::size_t>()).at("primitives")) {
            add_primitive(primitive, to_world);
        }
    }
    for (const json& child : node.value("children", json::array())) {
        add_node(document_.at("nodes").at(child.get<std::size_t>()), to_world);
    }
}

/// Floats and unsigned integers, tightly packed.
double FileScene::number(const json& accessor, std::size_t element, std::size_t component) const {
    const json& view = document_.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
    const std::string type = accessor.at("type");
    const std::size_t components = type == "SCALAR" ? 1 : std::size_t(type.back() - '0');
    const int kind = accessor.at("componentType");
    const std::size_t size = kind == 5123 ? 2 : 4;
    const std::size_t at = view.value("byteOffset", std::size_t(0)) + (element * components + component) * size;
    return kind == 5123 ? bytes_at<std::uint16_t>(bytes_, at) : bytes_at<float>(bytes_, at);
}

void FileScene::add_primitive(const json& primitive, const glm::dmat4& to_world) {
    const json& attributes = primitive.at("attributes");
    const json& accessors = document_.at("accessors");
    const auto read = [&](const char* name, std::size_t vertex, auto& out) {
        const json& accessor = accessors.at(attributes.at(name).get<std::size_t>());
        for (int i = 0; i < out.length(); ++i) {
            out[i] = number(accessor, vertex, std::size_t(i));
        }
    };
    const json& indices = accessors.at(primitive.at("indices").get<std::size_t>());
    for (std::size_t i = 0; i < indices.at("count").get<std::size_t>(); ++i) {
        const auto index = std::size_t(number(indices, i, 0));
        if (i % 3 == 0) {
            triangles_.push_back({{}, glm::dmat3(to_world), document_.at("materials").at(primitive.at("material").get<std::size_t>())});
        }
        FileVertex& vertex = triangles_.back().vertices[i % 3];
        glm::dvec4 position(1);
        glm::dvec3 local(0);
        read("POSITION", index, local);
        position = glm::dvec4(local, 1);
        vertex.position = glm::dvec3(to_world * position);
        if (attributes.contains("NORMAL")) {
            read("NORMAL", index, vertex.normal.emplace());
        }
        if (attributes.contains("TANGENT")) {
            read("TANGENT", index, vertex.tangent.emplace());
        }
        for (const char* name : {"TEXCOORD_0", "TEXCOORD_1"}) {
            if (attributes.contains(name)) {
                read(name, index, vertex.uv[name[9] - '0']);
            }
        }
        if (attributes.contains("COLOR_0")) {
            read("COLOR_0", index, vertex.color);
        }
    }
}

}  // namespace diptych::core::tests
