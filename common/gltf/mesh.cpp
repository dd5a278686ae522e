#include "gltf/mesh.h"

#include <optional>

#include "gltf/attributes.h"
#include "gltf/tangents.h"
#include "gltf/triangles.h"

namespace diptych::core::gltf {
namespace {

int default_material(Scene& scene) {
    const char* const name = "(default)";
    if (scene.materials.empty() || scene.materials.back().name != name) {
        scene.materials.emplace_back().name = name;
    }
    return static_cast<int>(scene.materials.size()) - 1;
}

int find_material(const Document& document, Scene& scene, int index, const std::string& object) {
    if (index == none) {
        return default_material(scene);
    }
    if (index < 0 || static_cast<std::size_t>(index) >= document.model.materials.size()) {
        fail(document, object + ".material", "there is no materials[" + std::to_string(index) + "]");
    }
    return index;
}

// The bind pose, or whatever pose the joints are in: glTF 2.0, section 3.7.3.
void apply_skin(Document& document, const std::vector<glm::dmat4>& joints, const std::string& object,
                Attributes& attributes) {
    if (attributes.joints.empty()) {
        warn(document, object, "stands in a skinned node, but has no JOINTS_0 and WEIGHTS_0; left unskinned");
        return;
    }
    for (std::size_t i = 0; i < attributes.positions.size(); ++i) {
        glm::dmat4 sum(0);
        double total = 0;
        for (std::size_t set = 0; set < attributes.joints.size(); ++set) {
            for (int k = 0; k < 4; ++k) {
                const auto weight = static_cast<double>(attributes.weights[set][i][k]);
                const std::uint32_t joint = attributes.joints[set][i][k];
                if (weight == 0) {
                    continue;
                }
                if (joint >= joints.size()) {
                    fail(document, object,
                         "vertex " + std::to_string(i) + " names joint " + std::to_string(joint) + " of " +
                             std::to_string(joints.size()));
                }
                sum += weight * joints[joint];
                total += weight;
            }
        }
        const glm::dmat4 matrix = total > 0 ? sum / total : glm::dmat4(1);
        attributes.positions[i] = glm::vec3(matrix * glm::dvec4(attributes.positions[i], 1));
        const glm::dmat3 linear(matrix);
        if (!attributes.normals.empty()) {
            // The cofactor matrix carries normals as the inverse transpose does, and exists where that does not.
            const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                                      glm::cross(linear[0], linear[1]));
            const glm::dvec3 normal = cofactor * glm::dvec3(attributes.normals[i]);
            attributes.normals[i] = glm::vec3(glm::determinant(linear) < 0 ? -normal : normal);
        }
        if (!attributes.tangents.empty()) {
            const glm::dvec3 tangent = linear * glm::dvec3(attributes.tangents[i]);
            attributes.tangents[i] = glm::vec4(glm::vec3(tangent), attributes.tangents[i].w);
        }
    }
}

void warn_missing_uvs(Document& document, const Material& material, const Primitive& primitive,
                      const std::string& object) {
    for (const auto member : texture_slots) {
        const TextureSlot& slot = material.*member;
        if (slot.texture != none && primitive.uvs[static_cast<std::size_t>(slot.uv_set)].empty()) {
            warn(document, object,
                 "lacks TEXCOORD_" + std::to_string(slot.uv_set) + ", which its material's textures read; taken as 0");
        }
    }
}

// Nothing where the primitive has no triangles.
std::optional<Primitive> import_primitive(Document& document, Scene& scene, const tinygltf::Primitive& source,
                                          const MeshUse& use, const std::string& object) {
    if (source.attributes.find("POSITION") == source.attributes.end()) {
        warn(document, object, "has no POSITION; left out");
        return std::nullopt;
    }
    const int material_index = find_material(document, scene, source.material, object);
    Attributes attributes = read_attributes(document, source, use.weights, !use.joints.empty(), object);
    std::vector<glm::uvec3> triangles = read_triangles(document, source, attributes.positions.size(), object);
    if (!use.joints.empty()) {
        apply_skin(document, use.joints, object, attributes);
    }
    Primitive primitive;
    primitive.material = material_index;
    primitive.positions = std::move(attributes.positions);
    primitive.normals = std::move(attributes.normals);
    primitive.uvs = std::move(attributes.uvs);
    primitive.colors = std::move(attributes.colors);
    primitive.triangles = std::move(triangles);
    const Material& material = scene.materials[static_cast<std::size_t>(material_index)];
    const bool has_normal_map = material.normal_texture.texture != none && !material.unlit;
    // Without normals the given tangents are to be ignored.
    if (has_normal_map && !primitive.normals.empty()) {
        primitive.tangents = std::move(attributes.tangents);
    }
    clean_primitive(document, primitive, object);
    if (primitive.triangles.empty()) {
        warn(document, object, "has no triangles; left out");
        return std::nullopt;
    }
    warn_missing_uvs(document, material, primitive, object);
    if (has_normal_map && primitive.tangents.empty()) {
        derive_tangents(primitive, material.normal_texture);
    }
    return primitive;
}

}  // namespace

Mesh import_mesh(Document& document, Scene& scene, int index, const MeshUse& use) {
    const tinygltf::Mesh& source = document.model.meshes[static_cast<std::size_t>(index)];
    Mesh mesh;
    mesh.name = source.name;
    const std::string object = label("meshes", static_cast<std::size_t>(index), source.name);
    for (std::size_t i = 0; i < source.primitives.size(); ++i) {
        std::optional<Primitive> primitive =
            import_primitive(document, scene, source.primitives[i], use, object + "." + label("primitives", i));
        if (primitive) {
            mesh.primitives.push_back(*std::move(primitive));
        }
    }
    return mesh;
}

}  // namespace diptych::core::gltf
