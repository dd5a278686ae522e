#include "oracle_renderer/oracle_renderer.h"

#include <fmt/format.h>

#include <thread>

#include "clock.h"
#include "error.h"

namespace diptych::core {

namespace {

/// A double as the film's pair of floats.
void split(const glm::dvec3& value, glm::vec3& high, glm::vec3& low) {
    high = glm::vec3(value);
    low = glm::vec3(value - glm::dvec3(high));
}

shared::FilmPixel to_film(const OraclePixel& pixel) {
    shared::FilmPixel out{};
    split(pixel.sum, out.sum, out.compensation);
    out.samples = static_cast<std::uint32_t>(pixel.samples);
    out.nonfinite = static_cast<std::uint32_t>(pixel.nonfinite);
    out.rays = static_cast<std::uint32_t>(pixel.rays);
    out.ray_wraps = static_cast<std::uint32_t>(pixel.rays >> 32U);
    return out;
}

/// The film's squares are about the first sample in float, ours about it in double.
shared::FilmMoments to_moments(const OraclePixel& pixel) {
    shared::FilmMoments out{};
    out.first = glm::vec3(pixel.first);
    const glm::dvec3 shift = pixel.first - glm::dvec3(out.first);
    const double n = static_cast<double>(pixel.samples);
    const glm::dvec3 squares = pixel.sum_squares + 2.0 * shift * (pixel.sum - n * pixel.first) + n * shift * shift;
    split(squares, out.sum_squares, out.compensation);
    return out;
}

shared::FilmFirstHit to_first_hit(const OraclePixel& pixel) {
    shared::FilmFirstHit out{};
    const double n = static_cast<double>(pixel.samples + pixel.nonfinite);
    if (n > 0) {
        out.albedo = glm::vec3(pixel.albedo / n);
        out.normal = glm::vec3(pixel.normal / n);
        out.depth = static_cast<float>(pixel.depth / n);
    }
    return out;
}

OracleSettings oracle_settings(const RenderSettings& settings, oracle::Mode mode) {
    OracleSettings out;
    out.width = settings.width;
    out.height = settings.height;
    out.max_depth = settings.max_depth;
    out.seed = settings.seed;
    out.mode = mode;
    out.distribution = settings.brdf == BrdfModel::ggx ? oracle::Distribution::ggx : oracle::Distribution::blinn_phong;
    out.normal_maps = settings.normal_maps == NormalMaps::shading ? oracle::NormalMaps::shading
                                                                  : oracle::NormalMaps::microfacet;
    out.camera = settings.camera;
    return out;
}

class OracleRenderer final : public Renderer {
public:
    OracleRenderer(const Scene& scene, const RenderSettings& settings, oracle::Mode mode, int threads)
        : scene_(scene), settings_(settings), oracle_settings_(oracle_settings(settings, mode)),
          wanted_threads_(threads),
          threads_(threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency())) {
        begin();
        costs_.build_seconds = building_.seconds();
        costs_.bytes = oracle_->bytes();
        costs_.acceleration_bytes = oracle_->acceleration_bytes();
    }

    std::string backend() const override { return "oracle"; }
    std::string device() const override { return fmt::format("double precision on {} CPU threads", threads_); }
    Capabilities capabilities() const override { return {}; }
    RendererCosts costs() const override { return costs_; }

    void render(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) override {
        const Stopwatch watch;
        oracle_->render(first, count, cancel);
        seconds_ += watch.seconds();
    }

    void restart(std::uint32_t seed) override {
        oracle_settings_.seed = seed;
        oracle_->restart(seed);
    }

    void move_to(const PackedScene&) override { begin(); }

    double device_seconds() const override { return seconds_; }

    Film film() const override {
        Film film;
        film.width = settings_.width;
        film.height = settings_.height;
        for (const OraclePixel& pixel : oracle_->image().pixels) {
            film.pixels.push_back(to_film(pixel));
            if (settings_.standard_error) {
                film.moments.push_back(to_moments(pixel));
            }
            if (settings_.first_hit_layers) {
                film.first_hits.push_back(to_first_hit(pixel));
            }
        }
        return film;
    }

    TraversalBench bench_traversal(std::uint32_t) override {
        throw Error("`backend` oracle: has no bare traversal to measure; use cpu or vulkan");
    }

private:
    void begin() { oracle_ = std::make_unique<Oracle>(scene_, oracle_settings_, wanted_threads_); }

    Stopwatch building_;
    const Scene& scene_;
    RenderSettings settings_;
    OracleSettings oracle_settings_;
    int wanted_threads_;
    int threads_;
    std::unique_ptr<Oracle> oracle_;
    RendererCosts costs_;
    double seconds_ = 0;
};

}  // namespace

oracle::Mode oracle_mode_from_name(const std::string& name) {
    if (name == "mis") {
        return oracle::Mode::mis;
    }
    if (name == "bsdf") {
        return oracle::Mode::bsdf;
    }
    if (name == "hemisphere") {
        return oracle::Mode::hemisphere;
    }
    if (name == "area") {
        return oracle::Mode::area;
    }
    throw Error(fmt::format("`oracle_mode` {}: there are only mis, bsdf, hemisphere, area", name));
}

std::unique_ptr<Renderer> make_oracle_renderer(const Scene& scene, const RenderSettings& settings, oracle::Mode mode,
                                               int threads) {
    return std::make_unique<OracleRenderer>(scene, settings, mode, threads);
}

}  // namespace diptych::core
