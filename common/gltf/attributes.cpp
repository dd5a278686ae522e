#include "gltf/attributes.h"

#include <algorithm>
#include <cstring>
#include <map>

#include "gltf/accessor.h"
#include "scene/scene.h"

namespace diptych::core::gltf {
namespace {

using Names = std::map<std::string, int>;

template <typename Vector, typename Number>
std::vector<Vector> pack(const std::vector<Number>& numbers) {
    static_assert(sizeof(Vector) == Vector::length() * sizeof(Number));
    std::vector<Vector> vectors(numbers.size() / static_cast<std::size_t>(Vector::length()));
    if (!numbers.empty()) {  // memcpy takes no null pointer
        std::memcpy(static_cast<void*>(vectors.data()), numbers.data(), numbers.size() * sizeof(Number));
    }
    return vectors;
}

class Reader {
public:
    Reader(Document& document, const std::string& object) : document_(document), object_(object) {}

    std::string name(const std::string& attribute) const { return object_ + "." + attribute; }

    const tinygltf::Accessor& accessor(const Names& names, const std::string& attribute) const {
        return find_accessor(document_, names.at(attribute), name(attribute));
    }

    template <typename Vector>
    std::vector<Vector> floats(const Names& names, const std::string& attribute) {
        if (names.find(attribute) == names.end()) {
            return {};
        }
        check_encoding(accessor(names, attribute), attribute);
        return counted(pack<Vector>(read_numbers(document_, names.at(attribute), Vector::length(), name(attribute))),
                       attribute);
    }

    // COLOR_0 with three or four components.
    std::vector<glm::vec4> colors(const Names& names) {
        if (names.find("COLOR_0") == names.end() || accessor(names, "COLOR_0").type == TINYGLTF_TYPE_VEC4) {
            return floats<glm::vec4>(names, "COLOR_0");
        }
        const std::vector<glm::vec3> rgb = floats<glm::vec3>(names, "COLOR_0");
        std::vector<glm::vec4> rgba(rgb.size());
        std::transform(rgb.begin(), rgb.end(), rgba.begin(), [](glm::vec3 c) { return glm::vec4(c, 1); });
        return rgba;
    }

    std::vector<glm::uvec4> joints(const Names& names, const std::string& attribute) {
        return counted(pack<glm::uvec4>(read_integers(document_, names.at(attribute), 4, name(attribute))), attribute);
    }

    void expect(std::size_t count) { count_ = count; }

private:
    template <typename Vector>
    std::vector<Vector> counted(std::vector<Vector> vectors, const std::string& attribute) const {
        if (count_ != 0 && vectors.size() != count_) {
            fail(document_, name(attribute),
                 "has " + std::to_string(vectors.size()) + " elements, POSITION has " + std::to_string(count_));
        }
        return vectors;
    }

    void check_encoding(const tinygltf::Accessor& accessor, const std::string& attribute) {
        if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) {
            return;
        }
        const bool geometric = attribute == "POSITION" || attribute == "NORMAL" || attribute == "TANGENT";
        if (geometric && !declares_extension(document_, "KHR_mesh_quantization")) {
            warn(document_, name(attribute), "is quantised, but the file does not declare KHR_mesh_quantization");
        }
        if (!geometric && !accessor.normalized && attribute.rfind("TEXCOORD", 0) != 0) {
            fail(document_, name(attribute), "holds integers that are not normalized");
        }
        if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
            fail(document_, name(attribute), "holds 32-bit integers, which glTF 2.0 does not allow here");
        }
    }

    Document& document_;
    std::string object_;
    std::size_t count_ = 0;
};

template <typename Base, typename Delta>
void add_scaled(std::vector<Base>& base, const std::vector<Delta>& deltas, float weight) {
    const std::size_t count = std::min(base.size(), deltas.size());
    for (std::size_t i = 0; i < count; ++i) {
        for (int c = 0; c < Delta::length(); ++c) {
            base[i][c] += weight * deltas[i][c];
        }
    }
}

void apply_targets(Document& document, const tinygltf::Primitive& primitive, const std::vector<double>& weights,
                   std::size_t count, const std::string& object, Attributes& attributes) {
    for (std::size_t t = 0; t < primitive.targets.size() && t < weights.size(); ++t) {
        const auto weight = static_cast<float>(weights[t]);
        if (weight == 0) {
            continue;
        }
        const Names& names = primitive.targets[t];
        Reader reader(document, object + ".targets[" + std::to_string(t) + "]");
        reader.expect(count);
        add_scaled(attributes.positions, reader.floats<glm::vec3>(names, "POSITION"), weight);
        add_scaled(attributes.normals, reader.floats<glm::vec3>(names, "NORMAL"), weight);
        add_scaled(attributes.tangents, reader.floats<glm::vec3>(names, "TANGENT"), weight);
        add_scaled(attributes.uvs[0], reader.floats<glm::vec2>(names, "TEXCOORD_0"), weight);
        add_scaled(attributes.uvs[1], reader.floats<glm::vec2>(names, "TEXCOORD_1"), weight);
        add_scaled(attributes.colors, reader.colors(names), weight);
    }
}

}  // namespace

Attributes read_attributes(Document& document, const tinygltf::Primitive& primitive,
                           const std::vector<double>& morph_weights, bool skinned, const std::string& object) {
    const Names& names = primitive.attributes;
    Reader reader(document, object + ".attributes");
    Attributes attributes;
    attributes.positions = reader.floats<glm::vec3>(names, "POSITION");
    const std::size_t count = attributes.positions.size();
    if (count == 0) {
        fail(document, object + ".attributes.POSITION", "has no elements");
    }
    reader.expect(count);
    attributes.normals = reader.floats<glm::vec3>(names, "NORMAL");
    attributes.tangents = reader.floats<glm::vec4>(names, "TANGENT");
    attributes.uvs[0] = reader.floats<glm::vec2>(names, "TEXCOORD_0");
    attributes.uvs[1] = reader.floats<glm::vec2>(names, "TEXCOORD_1");
    attributes.colors = reader.colors(names);
    for (int set = 0; skinned; ++set) {
        const std::string joints = "JOINTS_" + std::to_string(set);
        const std::string weights = "WEIGHTS_" + std::to_string(set);
        if (names.find(joints) == names.end() || names.find(weights) == names.end()) {
            break;
        }
        attributes.joints.push_back(reader.joints(names, joints));
        attributes.weights.push_back(reader.floats<glm::vec4>(names, weights));
    }
    apply_targets(document, primitive, morph_weights, count, object, attributes);
    return attributes;
}

}  // namespace diptych::core::gltf
