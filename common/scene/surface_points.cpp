#include "scene/surface_points.h"

#include <algorithm>
#include <cmath>

namespace diptych::core {
namespace {

double luminance(const glm::dvec3& c) {
    return glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722));
}

double linear_of_srgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

const Material& material_of(const Scene& scene, const Primitive& primitive) {
    return scene.materials[static_cast<std::size_t>(primitive.material)];
}

int wrapped_texel(double u, int size, Wrap mode) {
    if (mode == Wrap::repeat) {
        u -= std::floor(u);
    } else if (mode == Wrap::mirror) {
        u = 1 - std::abs(u - 2 * std::floor(u / 2) - 1);
    }
    return u > 0 ? static_cast<int>(std::min(u * size, size - 1.0)) : 0;  // 0 for NaN too
}

/// Encoded as stored; white where the slot has no texture.
glm::dvec4 nearest_texel(const Scene& scene, const TextureSlot& slot, const Primitive& primitive,
                         const glm::uvec3& triangle, const glm::dvec3& weights) {
    const std::vector<glm::vec2>& uvs = primitive.uvs[static_cast<std::size_t>(slot.uv_set)];
    if (slot.texture == none) {
        return glm::dvec4(1);
    }
    glm::dvec3 uv(0, 0, 1);
    if (!uvs.empty()) {
        uv = {weights.x * glm::dvec2(uvs[triangle.x]) + weights.y * glm::dvec2(uvs[triangle.y]) +
                  weights.z * glm::dvec2(uvs[triangle.z]),
              1};
    }
    const Texture& texture = scene.textures[static_cast<std::size_t>(slot.texture)];
    const TextureImage& image = scene.images[static_cast<std::size_t>(texture.image)];
    const int x = wrapped_texel(glm::dot(glm::dvec3(slot.u_row), uv), image.width, texture.wrap_u);
    const int y = wrapped_texel(glm::dot(glm::dvec3(slot.v_row), uv), image.height, texture.wrap_v);
    const auto index =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
    const std::uint8_t* texel = image.rgba.data() + 4 * index;
    return glm::dvec4(texel[0], texel[1], texel[2], texel[3]) / 255.0;
}

struct WorldTriangle {
    glm::dvec3 corner, edge_1, edge_2;
    glm::dvec3 front;  // unit, of the side that emits
    double area;
};

WorldTriangle placed(const Instance& instance, const Primitive& primitive, const glm::uvec3& triangle) {
    const auto world = [&](unsigned vertex) {
        return glm::dvec3(instance.object_to_world * glm::dvec4(primitive.positions[vertex], 1));
    };
    WorldTriangle out{};
    out.corner = world(triangle.x);
    out.edge_1 = world(triangle.y) - out.corner;
    out.edge_2 = world(triangle.z) - out.corner;
    const glm::dvec3 cross = glm::cross(out.edge_1, out.edge_2);
    const double length = glm::length(cross);
    if (length > 0 && std::isfinite(length)) {
        const bool mirrored = glm::determinant(glm::dmat3(instance.object_to_world)) < 0;
        out.front = cross / (mirrored ? -length : length);
        out.area = 0.5 * length;
    }
    return out;
}

template <typename Visit>
void each_emitting_triangle(const Scene& scene, const std::vector<glm::dvec3>& peaks, const Visit& visit) {
    for (const Instance& instance : scene.instances) {
        for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
            const double brightness = luminance(peaks[static_cast<std::size_t>(primitive.material)]);
            for (std::size_t i = 0; brightness > 0 && i < primitive.triangles.size(); ++i) {
                visit(primitive, primitive.triangles[i], placed(instance, primitive, primitive.triangles[i]),
                      brightness);
            }
        }
    }
}

/// The R2 sequence (Roberts 2018) over a triangle, folded along the diagonal.
glm::dvec3 spread_weights(std::size_t index) {
    double u = 0.5 + static_cast<double>(index) * 0.7548776662466927;
    double v = 0.5 + static_cast<double>(index) * 0.5698402909980532;
    u -= std::floor(u);
    v -= std::floor(v);
    const bool fold = u + v > 1;
    u = fold ? 1 - u : u;
    v = fold ? 1 - v : v;
    return {1 - u - v, u, v};
}

}  // namespace

std::vector<glm::dvec3> peak_emissions(const Scene& scene) {
    std::vector<glm::dvec3> factors;
    std::vector<double> strengths;
    for (const Material& material : scene.materials) {
        const bool moves = material.moving_emission && !material.unlit;
        const glm::vec3 still = material.unlit ? glm::vec3(material.base_color) : material.emission;
        factors.emplace_back(moves ? material.moving_emission->factor : still);
        strengths.push_back(moves ? static_cast<double>(material.moving_emission->strength) : 1);
    }
    for (const Animation& animation : scene.animations) {
        for (const Channel& channel : animation.channels) {
            const bool factor = channel.property == AnimatedProperty::emissive_factor;
            if ((!factor && channel.property != AnimatedProperty::emissive_strength) ||
                scene.materials[static_cast<std::size_t>(channel.target)].unlit) {
                continue;
            }
            for (const float time : channel.times) {
                const glm::dvec4 value = sample_channel(channel, static_cast<double>(time));
                glm::dvec3& peak = factors[static_cast<std::size_t>(channel.target)];
                double& strength = strengths[static_cast<std::size_t>(channel.target)];
                peak = factor ? glm::max(peak, glm::dvec3(value)) : peak;
                strength = factor ? strength : std::max(strength, value.x);
            }
        }
    }
    for (std::size_t i = 0; i < factors.size(); ++i) {
        factors[i] *= strengths[i];
    }
    return factors;
}

double emission_at(const Scene& scene, const glm::dvec3& peak, const Primitive& primitive, const glm::uvec3& triangle,
                   const glm::dvec3& weights) {
    const Material& material = material_of(scene, primitive);
    const TextureSlot& slot = material.unlit ? material.base_color_texture : material.emission_texture;
    const glm::dvec4 texel = nearest_texel(scene, slot, primitive, triangle, weights);
    return luminance(peak * glm::dvec3(linear_of_srgb(texel.x), linear_of_srgb(texel.y), linear_of_srgb(texel.z)));
}

bool covered_at(const Scene& scene, const Primitive& primitive, const glm::uvec3& triangle, const glm::dvec3& weights) {
    const Material& material = material_of(scene, primitive);
    if (material.alpha_mode == AlphaMode::opaque) {
        return true;
    }
    const double alpha = static_cast<double>(material.base_color.a) *
                         nearest_texel(scene, material.base_color_texture, primitive, triangle, weights).w;
    return alpha >= (material.alpha_mode == AlphaMode::mask ? static_cast<double>(material.alpha_cutoff) : 0.5);
}

std::vector<SurfacePoint> emitting_points(const Scene& scene, const std::vector<glm::dvec3>& peaks, int count) {
    double total = 0;
    each_emitting_triangle(scene, peaks,
                           [&](const Primitive&, const glm::uvec3&, const WorldTriangle& at, double brightness) {
                               total += at.area * brightness;
                           });
    std::vector<SurfacePoint> points;
    if (!(total > 0) || !std::isfinite(total)) {
        return points;
    }
    const double step = total / count;
    double passed = 0;
    std::size_t index = 0;
    each_emitting_triangle(
        scene, peaks,
        [&](const Primitive& primitive, const glm::uvec3& triangle, const WorldTriangle& at, double brightness) {
            passed += at.area * brightness;
            for (; (static_cast<double>(index) + 0.5) * step < passed; ++index) {
                const glm::dvec3 weights = spread_weights(index);
                if (covered_at(scene, primitive, triangle, weights)) {
                    SurfacePoint& point = points.emplace_back();
                    point.position = at.corner + weights.y * at.edge_1 + weights.z * at.edge_2;
                    point.normal = at.front;
                    point.material = primitive.material;
                    point.two_sided = material_of(scene, primitive).double_sided;
                    point.area = step / brightness;
                    point.emission = emission_at(scene, peaks[static_cast<std::size_t>(primitive.material)], primitive,
                                                 triangle, weights);
                }
            }
        });
    return points;
}

}  // namespace diptych::core
