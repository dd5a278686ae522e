#include "oracle_renderer/oracle_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "clock.h"
#include "error.h"

namespace diptych::core {

namespace {

/// Digits of the oracle that lie below the film's (numbers/exact_sum.h).
constexpr int lower_digits = 32;

void put_word(std::uint64_t bin, shared::uint& low, shared::uint& high) {
    low = static_cast<shared::uint>(bin);
    high = static_cast<shared::uint>(bin >> 32U);
}

/// The same bins: the film's digits are the oracle's.
template <int power>
shared::ExactSum to_film(const oracle::ExactSum<3, 3, power>& sum) {
    shared::ExactSum out{};
    const int base = sum.base - power * lower_digits;
    out.base = static_cast<shared::uint>(std::max(base, 0));
    for (int k = std::max(-base, 0); k < 3; ++k) {
        for (int c = 0; c < 3; ++c) {
            put_word(sum.sums[c][k], out.low[k + std::min(base, 0)][c], out.high[k + std::min(base, 0)][c]);
        }
    }
    return out;
}

shared::ExactScalar to_film(const oracle::ExactSum<1, 2>& sum) {
    shared::ExactScalar out{};
    const int base = sum.base - lower_digits;
    out.base = static_cast<shared::uint>(std::max(base, 0));
    for (int k = std::max(-base, 0); k < 2; ++k) {
        put_word(sum.sums[0][k], out.low[k + std::min(base, 0)], out.high[k + std::min(base, 0)]);
    }
    return out;
}

shared::FixedSum to_film(const std::array<std::int64_t, 3>& sum) {
    static_assert(OraclePixel::fixed_unit == 1.0 / 268435456);
    shared::FixedSum out{};
    for (int c = 0; c < 3; ++c) {
        put_word(static_cast<std::uint64_t>(sum[c]), out.low[c], out.high[c]);
    }
    return out;
}

shared::FilmPixel to_film(const OraclePixel& pixel) {
    shared::FilmPixel out{};
    out.sum = to_film(pixel.sum);
    out.samples = static_cast<std::uint32_t>(pixel.samples);
    out.nonfinite = static_cast<std::uint32_t>(pixel.nonfinite);
    out.rays = static_cast<std::uint32_t>(pixel.rays);
    out.ray_wraps = static_cast<std::uint32_t>(pixel.rays >> 32U);
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
                film.moments.push_back({to_film(pixel.squares)});
            }
            if (settings_.first_hit_layers) {
                film.first_hits.push_back({to_film(pixel.albedo), to_film(pixel.normal), to_film(pixel.depth)});
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
