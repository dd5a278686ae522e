#include "oracle/oracle.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>

#include <algorithm>
#include <cmath>

#include "error.h"
#include "oracle/camera.h"
#include "parallel.h"

namespace diptych::core {

namespace {

using namespace oracle;

/// Samples that share a generator: seeding costs as much as a path does.
constexpr std::uint64_t run_length = 16;

bool is_bad(const dvec3& v) {
    const auto good = [](double x) { return std::isfinite(x) && x >= 0; };
    return !(good(v.x) && good(v.y) && good(v.z));
}

void check(const Scene& scene, const OracleSettings& settings) {
    if (settings.width < 1 || settings.height < 1) {
        throw Error(fmt::format("{}: oracle: no image of {}x{}", scene.name, settings.width, settings.height));
    }
    if (settings.camera < 0 || std::size_t(settings.camera) >= scene.cameras.size()) {
        throw Error(fmt::format("{}: oracle: no camera {}", scene.name, settings.camera));
    }
}

}  // namespace

glm::dvec3 OraclePixel::mean() const {
    const long double n = std::max<std::uint64_t>(samples, 1);
    return {double(sum.value(0) / n), double(sum.value(1) / n), double(sum.value(2) / n)};
}

glm::dvec3 OraclePixel::variance_of_mean() const {
    const long double n = samples;
    dvec3 variance(0);
    for (int i = 0; i < 3; ++i) {
        const long double mean = sum.value(i) / n;
        variance[i] = double(std::max(0.0L, squares.value(i) / n - mean * mean) / (n - 1));
    }
    return variance;
}

namespace {

dvec3 fixed_mean(const std::array<std::int64_t, 3>& sum, std::uint64_t n) {
    const double scale = OraclePixel::fixed_unit / double(n);
    return {double(sum[0]) * scale, double(sum[1]) * scale, double(sum[2]) * scale};
}

}  // namespace

glm::dvec3 OraclePixel::mean_albedo() const {
    return fixed_mean(albedo, samples + nonfinite);
}

glm::dvec3 OraclePixel::mean_normal() const {
    return fixed_mean(normal, samples + nonfinite);
}

double OraclePixel::mean_depth() const {
    return double(depth.value(0) / static_cast<long double>(samples + nonfinite));
}

struct Oracle::State {
    OracleSettings settings;
    World world;
    Traversal traversal;
    Emitters emitters;
    SkyMap sky;
    OracleImage image;
    tbb::task_arena arena;

    State(const Scene& scene, const OracleSettings& s, int threads)
        : settings(s), world(make_world(scene)), traversal(world), emitters(world, emitter_choice(s.mode)),
          sky(scene.environment), arena(threads > 0 ? threads : tbb::task_arena::automatic) {
        image.pixels.resize(std::size_t(s.width) * std::size_t(s.height));
        image.depths.resize(s.by_depth ? image.pixels.size() * (s.max_depth + 1) : 0);
    }

    void add(std::size_t index, const PathResult& path, const std::vector<dvec3>& by_depth);
    void render_run(int x, int y, std::uint64_t run, std::uint64_t first, std::uint64_t end);
};

void Oracle::State::add(std::size_t index, const PathResult& path, const std::vector<dvec3>& by_depth) {
    OraclePixel& pixel = image.pixels[index];
    pixel.rays += path.rays;
    for (int i = 0; i < 3; ++i) {
        pixel.albedo[std::size_t(i)] += std::llround(path.first.base_color[i] / OraclePixel::fixed_unit);
        pixel.normal[std::size_t(i)] += std::llround(path.first.normal[i] / OraclePixel::fixed_unit);
    }
    pixel.depth.add({path.first.distance});
    const dvec3& radiance = path.radiance;
    if (is_bad(radiance)) {
        ++pixel.nonfinite;
        return;
    }
    ++pixel.samples;
    pixel.sum.add({radiance.x, radiance.y, radiance.z});
    pixel.squares.add({radiance.x, radiance.y, radiance.z});
    for (std::size_t k = 0; k < by_depth.size(); ++k) {
        OracleDepth& depth = image.depths[index * by_depth.size() + k];
        depth.sum += by_depth[k];
        depth.sum_squares += by_depth[k] * by_depth[k];
    }
}

/// The samples of one pixel and run that lie in [first, end). Those before are traced too, since the generator's state
/// depends on them.
void Oracle::State::render_run(int x, int y, std::uint64_t run, std::uint64_t first, std::uint64_t end) {
    const Camera& camera = world.scene->cameras[std::size_t(settings.camera)];
    const Paths paths{world,         traversal,          emitters,           sky, settings.distribution,
                      settings.mode, settings.max_depth, settings.normal_maps};
    const double width = settings.width;
    const double height = settings.height;
    const auto index = std::size_t(y) * std::size_t(settings.width) + std::size_t(x);
    Random random(settings.seed, index, run);
    std::vector<dvec3> by_depth(settings.by_depth ? settings.max_depth + 1 : 0);
    for (std::uint64_t sample = run * run_length; sample < std::min((run + 1) * run_length, end); ++sample) {
        const double film_x = (x + random.uniform()) / width;
        const double film_y = (y + random.uniform()) / height;
        const Ray ray = camera_ray(world, camera, width / height, film_x, film_y, random);
        std::fill(by_depth.begin(), by_depth.end(), dvec3(0));
        const PathResult path = trace_path(paths, ray, random, by_depth);
        if (sample >= first) {
            add(index, path, by_depth);
        }
    }
}

Oracle::Oracle(const Scene& scene, const OracleSettings& settings, int threads) {
    check(scene, settings);
    state_ = std::make_unique<State>(scene, settings, threads);
}

Oracle::~Oracle() = default;

void Oracle::render(std::uint64_t first, std::uint64_t count, const std::atomic<bool>& cancel) {
    const std::uint64_t end = first + count;
    for (std::uint64_t run = first / run_length; run * run_length < end && !cancel; ++run) {
        run_in(state_->arena, [&] {
            parallel_over(tbb::blocked_range<int>(0, state_->settings.height), [&](const auto& rows) {
                for (int y = rows.begin(); y < rows.end(); ++y) {
                    for (int x = 0; x < state_->settings.width && !cancel; ++x) {
                        state_->render_run(x, y, run, first, end);
                    }
                }
            });
        });
    }
}

void Oracle::restart(std::uint32_t seed) {
    state_->settings.seed = seed;
    state_->image.pixels.assign(state_->image.pixels.size(), {});
    state_->image.depths.assign(state_->image.depths.size(), {});
}

const OracleImage& Oracle::image() const {
    return state_->image;
}

std::uint64_t Oracle::bytes() const {
    return acceleration_bytes() + state_->world.triangles.size() * sizeof(Triangle) +
           state_->image.pixels.size() * sizeof(OraclePixel) + state_->image.depths.size() * sizeof(OracleDepth);
}

std::uint64_t Oracle::acceleration_bytes() const {
    return state_->traversal.bytes();
}

}  // namespace diptych::core
