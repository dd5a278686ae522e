// What tests of rendered pictures share: small renders on the CPU, their means with errors, scenes to render.
#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "backend/cpu_renderer.h"
#include "catch.h"
#include "pack/pack_parts.h"
#include "pack/packed_scene.h"
#include "render/film.h"
#include "render/film_statistics.h"
#include "settings/names.h"
#include "generate/shapes.h"
#include "gltf/import.h"

namespace diptych::core::tests {

inline constexpr std::array<Integrator, 3> integrators = {Integrator::brdf, Integrator::direct, Integrator::path};
inline constexpr std::array<BrdfModel, 2> brdf_models = {BrdfModel::ggx, BrdfModel::blinn_phong};

/// Independent samples, so that standard errors are what they say, and moments for them.
inline RenderSettings statistical_settings(int width, int height, Integrator integrator, std::uint32_t max_depth) {
    RenderSettings s;
    s.width = width;
    s.height = height;
    s.integrator = integrator;
    s.sampler = SamplerKind::independent;
    s.max_depth = max_depth;
    s.seed = 1;
    s.standard_error = true;
    return s;
}

inline Film render_cpu(const Scene& scene, const RenderSettings& settings, std::uint32_t spp, int threads = 2) {
    const PackedScene packed = pack_scene(scene, settings);
    const auto renderer = make_cpu_renderer(packed, threads);
    const std::atomic<bool> cancel{false};
    renderer->render(0, spp, cancel);
    return renderer->film();
}

/// The mean over all pixels, and its standard error by the pixels' own.
struct ImageMean {
    Rgb mean{};
    Rgb error{};
    std::uint64_t nonfinite = 0;
};

inline ImageMean image_mean(const Film& film) {
    ImageMean out;
    const double n = static_cast<double>(film.pixels.size());
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const Rgb mean = pixel_mean(film.pixels[i]);
        const Rgb error = pixel_standard_error(film.pixels[i], film.moments.at(i));
        for (std::size_t c = 0; c < 3; ++c) {
            out.mean[c] += mean[c] / n;
            out.error[c] += error[c] * error[c] / (n * n);
        }
        out.nonfinite += film.pixels[i].nonfinite;
    }
    for (double& e : out.error) {
        e = std::sqrt(e);
    }
    return out;
}

/// (a - b) over its standard error, of the channel where that is largest. Rounding of 1e-5 is no difference.
inline double worst_z(const ImageMean& a, const ImageMean& b) {
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const double rounding = 1e-5 * std::max(std::abs(a.mean[c]), std::abs(b.mean[c])) + 1e-12;
        const double error = std::hypot(a.error[c], b.error[c], rounding);
        worst = std::max(worst, std::abs(a.mean[c] - b.mean[c]) / error);
    }
    return worst;
}

/// Largest relative standard error of the difference: what a test by worst_z could see, up to a factor of five.
inline double relative_error(const ImageMean& a, const ImageMean& b) {
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const double scale = std::max({std::abs(a.mean[c]), std::abs(b.mean[c]), 1e-12});
        worst = std::max(worst, std::hypot(a.error[c], b.error[c]) / scale);
    }
    return worst;
}

/// Two films of one seed, pixel by pixel. If each pixel's difference has mean zero, `z` is of order 1 whatever the
/// tails, since it is normalised by the differences themselves (at most sqrt(pixels)); what both films share, such as a
/// lamp in view, cancels.
struct PairedDifference {
    double z = 0;               // of the worst channel
    double relative_error = 0;  // of the difference of the means, in units of the mean
};

inline PairedDifference paired_difference(const Film& a, const Film& b) {
    PairedDifference out;
    for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        double squares = 0;
        double total = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i) {
            const double x = pixel_mean(a.pixels[i])[c];
            const double y = pixel_mean(b.pixels[i])[c];
            sum += x - y;
            squares += (x - y) * (x - y);
            total += 0.5 * (x + y);
        }
        const double error = std::hypot(std::sqrt(squares), 1e-6 * total);
        out.z = std::max(out.z, error > 0 ? std::abs(sum) / error : 0.0);
        out.relative_error = std::max(out.relative_error, total > 0 ? error / total : 0.0);
    }
    return out;
}

inline ImageMean exactly(double value) {
    return {{value, value, value}, {}, 0};
}
inline ImageMean exactly(const Rgb& value) {
    return {value, {}, 0};
}

inline std::string describe(const ImageMean& m) {
    std::string text;
    for (std::size_t c = 0; c < 3; ++c) {
        text += std::to_string(m.mean[c]) + "+-" + std::to_string(m.error[c]) + " ";
    }
    return text;
}

/// Of structs without padding.
template <class T>
bool same_bytes(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// Bit for bit.
inline bool same_film(const Film& a, const Film& b) {
    if (a.pixels.size() != b.pixels.size()) {
        return false;
    }
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        if (!same_bytes(a.pixels[i], b.pixels[i])) {
            return false;
        }
    }
    return true;
}

/// White that only diffuses: no specular layer at all.
inline Material diffuse_material(float albedo) {
    Material m = make_material("diffuse", glm::vec3(albedo), 0, 1);
    m.specular = 0;
    return m;
}

/// A level square of half side `half` about `center`, front up or down.
inline Primitive horizontal_square(const glm::vec3& center, float half, bool front_up, int material) {
    Primitive p;
    p.material = material;
    const glm::vec3 x(half, 0, 0);
    const glm::vec3 z(0, 0, front_up ? -half : half);
    add_quad(p, center - x - z, center + x - z, center + x + z, center - x + z);
    return p;
}

/// A camera that sees one point of the scene, as good as.
inline Camera point_camera(const glm::dvec3& eye, const glm::dvec3& target) {
    return make_camera("point", eye, target, 0.01);
}

inline const std::vector<std::string>& own_scenes() {
    static const std::vector<std::string> names = {"cornell",    "veach-mis", "brdf-grid",  "furnace",
                                                   "normal-map", "courtyard", "mirror-maze"};
    return names;
}

/// One of scenes/, lit by a sky where it brings no light.
inline Scene load_own_scene(const std::string& name) {
    Scene scene = load_gltf(std::string(DIPTYCH_SOURCE_DIR) + "/scenes/" + name + ".gltf");
    if (name == "courtyard") {
        scene.environment.kind = Environment::Kind::constant;
        scene.environment.scale = glm::vec3(1.8F, 2.1F, 2.6F);
    }
    return scene;
}

/// A sky with a smooth gradient, and a sun in one texel that holds most of the light.
inline Environment sunny_sky(int width, int height, float sun) {
    Environment e;
    e.kind = Environment::Kind::map;
    e.width = width;
    e.height = height;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float t = static_cast<float>(y) / static_cast<float>(height);
            e.texels.emplace_back(0.3F + 0.2F * t, 0.4F, 0.8F - 0.5F * t);
        }
    }
    e.texels[static_cast<std::size_t>(width * (height / 4) + width / 3)] = glm::vec3(sun, 0.9F * sun, 0.7F * sun);
    return e;
}

}  // namespace diptych::core::tests
