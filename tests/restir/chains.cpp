#include "chains.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "render/film_statistics.h"
#include "scene/orbit.h"
#include "pose/pose.h"

namespace diptych::core::tests {
namespace {

/// The case's scene as frame `frame` shows it.
Scene posed(const ChainCase& c, std::uint32_t frame) {
    Scene scene = c.scene;
    if (c.seconds > 0) {
        pose_scene(scene, c.start + frame * c.seconds);
    }
    if (c.orbit != 0) {
        orbit_camera(scene.cameras[0], orbit_pivot(scene, scene.cameras[0]), c.orbit * frame);
    }
    return scene;
}

bool moves(const ChainCase& c) {
    return c.seconds > 0 || c.orbit != 0;
}

RenderSettings sized(RenderSettings settings, std::uint32_t side) {
    settings.width = static_cast<int>(side);
    settings.height = static_cast<int>(side);
    settings.sampler = SamplerKind::independent;
    return settings;
}

double sum_of(const shared::FilmPixel& p) {
    const Rgb sum = rounded(p.sum);
    return (sum[0] + sum[1] + sum[2]) / 3;
}

}  // namespace

namespace {

std::vector<std::vector<double>> chain_means(const ChainCase& c, const ChainSize& size,
                                             const std::vector<std::uint32_t>& frames, const MakeRenderer& make,
                                             std::uint32_t seed) {
    RenderSettings settings = sized(c.settings, size.tile * size.copies);
    settings.atlas_tile = size.tile;
    settings.moves = moves(c);
    settings.seed = seed;
    PackedScene packed = pack_scene(posed(c, 0), settings);
    const std::unique_ptr<Renderer> renderer = make(packed);
    const std::atomic<bool> cancel{false};
    const std::uint32_t chains = size.copies * size.copies;
    std::vector<double> before(chains, 0.0);
    std::vector<std::vector<double>> means;
    for (std::uint32_t frame = 0; frame <= frames.back(); ++frame) {
        if (frame > 0 && moves(c)) {
            pack_moment(posed(c, frame), settings, packed);
            renderer->move_to(packed);
        }
        const bool wanted = std::find(frames.begin(), frames.end(), frame) != frames.end();
        const bool next_wanted = std::find(frames.begin(), frames.end(), frame + 1) != frames.end();
        renderer->render(frame, 1, cancel);
        if (!wanted && !next_wanted) {
            continue;
        }
        const Film film = renderer->film();
        std::vector<double> sums(chains, 0.0);
        for (std::size_t i = 0; i < film.pixels.size(); ++i) {
            const auto side = static_cast<std::size_t>(film.width);
            sums[i / side / size.tile * size.copies + i % side / size.tile] += sum_of(film.pixels[i]);
        }
        if (wanted) {
            std::vector<double> mean(chains);
            for (std::uint32_t chain = 0; chain < chains; ++chain) {
                mean[chain] = (sums[chain] - before[chain]) / (size.tile * size.tile);
            }
            means.push_back(std::move(mean));
        }
        before = std::move(sums);
    }
    return means;
}

std::vector<double> path_means(const ChainCase& c, const ChainSize& size, std::uint32_t frame, std::uint32_t runs,
                               std::uint32_t spp, const MakeRenderer& make) {
    RenderSettings settings = sized(c.settings, size.tile);
    settings.integrator = Integrator::path;
    settings.atlas_tile = 0;
    // As the chain packs it: from frame 0, so that the origin is the same.
    PackedScene packed = pack_scene(posed(c, 0), settings);
    pack_moment(posed(c, frame), settings, packed);
    const std::unique_ptr<Renderer> renderer = make(packed);
    const std::atomic<bool> cancel{false};
    std::vector<double> means;
    for (std::uint32_t run = 0; run < runs; ++run) {
        renderer->restart(1000003 + run);
        renderer->render(0, spp, cancel);
        const Film film = renderer->film();
        double sum = 0;
        for (const shared::FilmPixel& pixel : film.pixels) {
            sum += sum_of(pixel) / pixel.samples;
        }
        means.push_back(sum / static_cast<double>(film.pixels.size()));
    }
    return means;
}

ChainCase of_depth_0(ChainCase c) {
    c.settings.max_depth = 0;
    return c;
}

void subtract(std::vector<double>& from, const std::vector<double>& what) {
    for (std::size_t i = 0; i < from.size(); ++i) {
        from[i] -= what[i];
    }
}

}  // namespace

std::vector<std::vector<double>> run_chains(const ChainCase& c, const ChainSize& size,
                                            const std::vector<std::uint32_t>& frames, const MakeRenderer& make,
                                            std::uint32_t seed) {
    std::vector<std::vector<double>> means = chain_means(c, size, frames, make, seed);
    const std::vector<std::vector<double>> seen = chain_means(of_depth_0(c), size, frames, make, seed);
    for (std::size_t i = 0; i < means.size(); ++i) {
        subtract(means[i], seen[i]);
    }
    return means;
}

std::vector<double> run_reference(const ChainCase& c, const ChainSize& size, std::uint32_t frame, std::uint32_t runs,
                                  std::uint32_t spp, const MakeRenderer& make) {
    std::vector<double> means = path_means(c, size, frame, runs, spp, make);
    subtract(means, path_means(of_depth_0(c), size, frame, runs, spp, make));
    return means;
}

Difference difference(const std::vector<double>& a, const std::vector<double>& b) {
    const auto moments = [](const std::vector<double>& x) {
        double mean = 0;
        for (const double v : x) {
            mean += v / static_cast<double>(x.size());
        }
        double squares = 0;
        for (const double v : x) {
            squares += (v - mean) * (v - mean);
        }
        const auto n = static_cast<double>(x.size());
        return std::pair(mean, squares / (n - 1) / n);
    };
    const auto [mean_a, variance_a] = moments(a);
    const auto [mean_b, variance_b] = moments(b);
    const double error = std::sqrt(variance_a + variance_b);
    return {(mean_a - mean_b) / error, 100 * (mean_a - mean_b) / mean_b, 196 * error / mean_b};
}

}  // namespace diptych::core::tests
