#include "oracle/texture.h"

#include <array>
#include <cmath>

namespace diptych::core::oracle {

namespace {

/// Index of the texel that stands at place `i` of an endless row.
int wrap_index(double i, int size, Wrap wrap) {
    if (wrap == Wrap::clamp) {
        return int(glm::clamp(i, 0.0, double(size - 1)));
    }
    if (wrap == Wrap::repeat) {
        return int(i - std::floor(i / size) * size);
    }
    const double period = 2.0 * size;
    const int place = int(i - std::floor(i / period) * period);
    return place < size ? place : 2 * size - 1 - place;
}

const std::array<double, 256>& srgb_table() {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = decode_srgb(double(i) / 255);
        }
        return values;
    }();
    return table;
}

struct Reader {
    const TextureImage& image;
    const Texture& texture;
    Encoding encoding;

    dvec4 texel(double x, double y) const {
        const auto column = std::size_t(wrap_index(x, image.width, texture.wrap_u));
        const auto row = std::size_t(wrap_index(y, image.height, texture.wrap_v));
        const std::uint8_t* bytes = &image.rgba[4 * (row * std::size_t(image.width) + column)];
        dvec4 value = dvec4(bytes[0], bytes[1], bytes[2], bytes[3]) / 255.0;
        if (encoding == Encoding::srgb) {
            for (int k = 0; k < 3; ++k) {
                value[k] = srgb_table()[bytes[k]];
            }
        }
        return value;
    }
};

}  // namespace

double decode_srgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

dvec4 sample_texture(const Scene& scene, const TextureSlot& slot, const Triangle& triangle, dvec2 barycentrics,
                     Encoding encoding, const dvec4& missing) {
    if (slot.texture == none) {
        return missing;
    }
    const Texture& texture = scene.textures[std::size_t(slot.texture)];
    const TextureImage& image = scene.images[std::size_t(texture.image)];
    const auto& uvs = triangle.primitive->uvs[std::size_t(slot.uv_set)];
    const dvec2 uv = uvs.empty() ? dvec2(0) : interpolate(uvs, triangle, barycentrics);
    const double u = dot(dvec3(slot.u_row), dvec3(uv, 1)) * image.width;
    const double v = dot(dvec3(slot.v_row), dvec3(uv, 1)) * image.height;
    const Reader reader{image, texture, encoding};
    if (texture.filter == Filter::nearest) {
        return reader.texel(std::floor(u), std::floor(v));
    }
    const double x = std::floor(u - 0.5);
    const double y = std::floor(v - 0.5);
    const double fx = u - 0.5 - x;
    const double fy = v - 0.5 - y;
    return bilinear(reader.texel(x, y), reader.texel(x + 1, y), reader.texel(x, y + 1), reader.texel(x + 1, y + 1), fx,
                    fy);
}

}  // namespace diptych::core::oracle
