// Filtered texture lookups against an implementation of their own, in double.
#include <random>

#include "leaves.h"
#include "render_fixture.h"
#include "film/tonemap.h"

namespace diptych::core {
namespace shared {
namespace {

/// The hooks that lookups need.
struct TextureKernel {
    const PackedScene& packed;

    bool feature(uint bit) const { return (packed.features & bit) != 0; }
    const Geometry& load_geometries(uint i) const { return packed.geometries.at(i); }
    const Instance& load_instances(uint i) const { return packed.instances.at(i); }
    const Material& load_materials(uint i) const { return packed.materials.at(i); }
    const TextureSlot& load_texture_slots(uint i) const { return packed.texture_slots.at(i); }
    const uvec3& load_triangles(uint i) const { return packed.triangles.at(i); }
    const vec2& load_uvs(uint i) const { return packed.uvs.at(i); }
    const vec4& load_colors(uint i) const { return packed.colors.at(i); }
    uint load_texels(uint i) const { return packed.texels.at(i); }
    float load_srgb_table(uint i) const { return packed.srgb_table.at(i); }

#include "geometry/texture.kernel.h"
};

}  // namespace
}  // namespace shared

namespace tests {
namespace {

double srgb_to_linear(double x) {
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

int wrapped(int i, int n, Wrap wrap) {
    if (wrap == Wrap::clamp) {
        return std::min(std::max(i, 0), n - 1);
    }
    const int period = wrap == Wrap::mirror ? 2 * n : n;
    const int j = ((i % period) + period) % period;
    return j < n ? j : period - 1 - j;
}

struct Lookup {
    const TextureImage& image;
    const Texture& texture;
    bool srgb;

    glm::dvec4 texel(int x, int y) const {
        const int column = wrapped(x, image.width, texture.wrap_u);
        const int row = wrapped(y, image.height, texture.wrap_v);
        glm::dvec4 out;
        for (int c = 0; c < 4; ++c) {
            const double value = image.rgba[static_cast<std::size_t>((row * image.width + column) * 4 + c)] / 255.0;
            out[c] = srgb && c < 3 ? srgb_to_linear(value) : value;
        }
        return out;
    }

    glm::dvec4 operator()(double u, double v) const {
        const double x = u * image.width;
        const double y = v * image.height;
        if (texture.filter == Filter::nearest) {
            return texel(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
        }
        const double left = std::floor(x - 0.5);
        const double top = std::floor(y - 0.5);
        const double s = x - 0.5 - left;
        const double t = y - 0.5 - top;
        const int i = static_cast<int>(left);
        const int j = static_cast<int>(top);
        return (1 - t) * ((1 - s) * texel(i, j) + s * texel(i + 1, j)) +
               t * ((1 - s) * texel(i, j + 1) + s * texel(i + 1, j + 1));
    }
};

TextureImage random_image(int width, int height, std::mt19937& random) {
    TextureImage image;
    image.name = "noise";
    image.width = width;
    image.height = height;
    for (int i = 0; i < width * height * 4; ++i) {
        image.rgba.push_back(static_cast<std::uint8_t>(random() >> 24));
    }
    return image;
}

}  // namespace
}  // namespace tests
}  // namespace diptych::core

using namespace diptych::core;
using namespace diptych::core::tests;

TEST_CASE("Lookups match double in every wrap mode, filter, size and encoding") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-3, 3);
    double worst = 0;
    int compared = 0;
    for (const auto& [width, height] : {std::pair(1, 1), {2, 3}, {5, 1}, {16, 16}, {7, 32}}) {
        for (const Wrap wrap_u : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
            for (const Wrap wrap_v : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
                for (const Filter filter : {Filter::nearest, Filter::linear}) {
                    Scene scene;
                    scene.name = "lookup";
                    scene.images = {random_image(3, 2, random), random_image(width, height, random)};
                    scene.textures = {{"other", 0, Wrap::repeat, Wrap::repeat, Filter::linear},
                                      {"t", 1, wrap_u, wrap_v, filter}};
                    Material m = diffuse_material(1);
                    m.base_color_texture.texture = 1;          // sRGB
                    m.metallic_roughness_texture.texture = 1;  // linear
                    m.emission_texture.texture = 0;
                    add_object(scene, "q", {horizontal_square(glm::vec3(0), 1, true, add_material(scene, m))});
                    const PackedScene packed = pack_scene(scene, {});
                    shared::TextureKernel kernel{packed};
                    const shared::Material& material = packed.materials[0];
                    for (int i = 0; i < 300; ++i) {
                        const glm::vec2 uv(place(random), place(random));
                        const double x = static_cast<double>(uv.x) * width;
                        const double y = static_cast<double>(uv.y) * height;
                        const auto near_edge = [](double a) { return std::abs(a - std::round(a)) < 1e-4; };
                        if (filter == Filter::nearest && (near_edge(x) || near_edge(y))) {
                            continue;
                        }
                        for (const bool srgb : {false, true}) {
                            const std::uint32_t slot =
                                srgb ? material.base_color_slot : material.metallic_roughness_slot;
                            const shared::vec4 got = kernel.sample_texture(packed.texture_slots.at(slot), uv);
                            const glm::dvec4 want = Lookup{scene.images[1], scene.textures[1],
                                                           srgb}(static_cast<double>(uv.x), static_cast<double>(uv.y));
                            for (int c = 0; c < 4; ++c) {
                                worst = std::max(worst, std::abs(static_cast<double>(got[c]) - want[c]));
                            }
                            ++compared;
                        }
                    }
                }
            }
        }
    }
    INFO("worst " << worst << " over " << compared);
    CHECK(compared > 40000);
    CHECK(worst < 4e-5);  // a coordinate of 3 is known to 2.4e-7, and a texture of 32 texels has slopes of up to 32
}

TEST_CASE("Texture transforms and the second set of coordinates reach the lookup") {
    std::mt19937 random(4);
    Scene scene;
    scene.name = "transform";
    scene.images = {random_image(8, 8, random)};
    scene.textures = {{"t", 0, Wrap::repeat, Wrap::repeat, Filter::linear}};
    Material m = diffuse_material(1);
    m.unlit = true;
    m.base_color_texture.texture = 0;
    m.base_color_texture.uv_set = 1;
    m.base_color_texture.u_row = {0.5F, 0.25F, 0.1F};
    m.base_color_texture.v_row = {-0.3F, 0.8F, 0.2F};
    Primitive square = horizontal_square(glm::vec3(0), 1, true, add_material(scene, m));
    square.uvs[0].assign(4, glm::vec2(0.5F));
    square.uvs[1] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};  // (x + 1)/2, (z + 1)/2
    add_object(scene, "q", {square});
    const Lookup lookup{scene.images[0], scene.textures[0], true};
    for (const glm::dvec2 p : {glm::dvec2(0.3, 0.1), glm::dvec2(-0.7, 0.52), glm::dvec2(0.11, -0.9)}) {
        scene.cameras = {point_camera({p.x + 0.001, 1, p.y}, {p.x, 0, p.y})};
        const Rgb mean = image_mean(render_cpu(scene, statistical_settings(4, 4, Integrator::path, 0), 16)).mean;
        const double u = (p.x + 1) / 2;
        const double v = (p.y + 1) / 2;
        const glm::dvec4 want = lookup(0.5 * u + 0.25 * v + 0.1, -0.3 * u + 0.8 * v + 0.2);
        for (int c = 0; c < 3; ++c) {
            CHECK(mean[static_cast<std::size_t>(c)] == Approx(want[c]).epsilon(1e-3).margin(1e-4));
        }
    }
}
