// Small glTF files with known numbers, written by the tests themselves.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <unistd.h>
#include <vector>

#include "gltf/import.h"
#include "temporary_folder.h"

namespace diptych::core::tests {

inline Scene load_text(const std::string& text) {
    const TemporaryFolder folder;
    return load_gltf(folder.write("scene.gltf", text));
}

inline std::string to_base64(const std::string& bytes) {
    const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63U] : '=';
        }
    }
    return text;
}

template <typename T>
std::string raw(std::initializer_list<T> values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), values.begin(), bytes.size());
    return bytes;
}

/// Collects binary data and the buffer views and accessors over it; text() wraps them into a whole file.
class GltfBuilder {
public:
    int view(const std::string& bytes, int stride = 0) {
        data_.resize((data_.size() + 3) / 4 * 4, '\0');
        views_ += std::string(views_.empty() ? "" : ",") + R"({"buffer":0,"byteOffset":)" +
                  std::to_string(data_.size()) + R"(,"byteLength":)" + std::to_string(bytes.size()) +
                  (stride > 0 ? R"(,"byteStride":)" + std::to_string(stride) : "") + "}";
        data_ += bytes;
        return view_count_++;
    }

    /// `extra` goes into the accessor's JSON as it is, commas included.
    int accessor(const std::string& bytes, int component_type, const std::string& type, int count,
                 const std::string& extra = "", int stride = 0) {
        return accessor_of(R"("bufferView":)" + std::to_string(view(bytes, stride)), component_type, type, count,
                           extra);
    }

    int accessor_of(const std::string& source, int component_type, const std::string& type, int count,
                    const std::string& extra = "") {
        accessors_ += std::string(accessors_.empty() ? "" : ",") + "{" + source + (source.empty() ? "" : ",") +
                      R"("componentType":)" + std::to_string(component_type) + R"(,"type":")" + type + R"(","count":)" +
                      std::to_string(count) + extra + "}";
        return accessor_count_++;
    }

    int floats(std::initializer_list<float> values, const std::string& type, int count, const std::string& extra = "") {
        return accessor(raw(values), 5126, type, count, extra);
    }

    /// A unit right triangle in the plane z = 0.
    int triangle() { return floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3); }

    /// `members` are the other members of the root object.
    std::string text(const std::string& members) const {
        return R"({"asset":{"version":"2.0"},)" + members + R"(,"buffers":[{"byteLength":)" +
               std::to_string(data_.size()) + R"(,"uri":"data:application/octet-stream;base64,)" + to_base64(data_) +
               R"("}],"bufferViews":[)" + views_ + R"(],"accessors":[)" + accessors_ + "]}";
    }

private:
    std::string data_;
    std::string views_;
    std::string accessors_;
    int view_count_ = 0;
    int accessor_count_ = 0;
};

/// A scene of one node with one mesh of one primitive.
inline std::string one_mesh(const std::string& primitive) {
    return R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"name":"m","primitives":[{)" +
           primitive + "}]}]";
}

/// The folder of real assets; see the tests' use of it for what happens where it is absent.
inline std::filesystem::path asset_folder() {
    const char* const given = std::getenv("DIPTYCH_ASSETS");
    return given != nullptr ? std::filesystem::path(given)
                            : std::filesystem::path(DIPTYCH_SOURCE_DIR) / "../shared/assets";
}

}  // namespace diptych::core::tests
