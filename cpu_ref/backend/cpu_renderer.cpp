#include "backend/cpu_renderer.h"

#include <tbb/blocked_range2d.h>

#include <algorithm>
#include <fstream>

#include "backend/path_batch.h"
#include "backend/path_recording.h"
#include "backend/resampling_stages.h"
#include "clock.h"
#include "parallel.h"

namespace diptych::core {
namespace {

constexpr int tile_size = 16;
// Samples of a pixel taken in one go: long enough to keep its film in registers, short enough to hear a cancel.
constexpr std::uint32_t samples_a_slice = 16;

// Scenes that need no more than these get kernels of their own, compiled without the rest.
constexpr std::uint32_t diffuse_features = shared::FEATURE_EMISSIVE | shared::FEATURE_CONSTANT_ENVIRONMENT |
                                           shared::FEATURE_STANDARD_ERROR | shared::FEATURE_FIRST_HIT_LAYERS |
                                           shared::FEATURE_LIGHT_SAMPLING | shared::FEATURE_LATER_VERTICES;
constexpr std::uint32_t plain_features = diffuse_features | shared::FEATURE_GGX;
constexpr std::uint32_t tree = shared::FEATURE_LIGHT_TREE;

class CpuRenderer final : public Renderer {
public:
    CpuRenderer(const PackedScene& packed, int threads)
        : packed_(&packed), constants_(packed.constants), arena_(threads > 0 ? threads : tbb::task_arena::automatic),
          scene_(run_in(arena_, [&] { return std::make_unique<EmbreeScene>(packed); })) {
        build_seconds_ = building_.seconds();
        lay_out_films();
    }

    std::string backend() const override { return "cpu"; }
    std::string device() const override { return cpu_name(); }

    Capabilities capabilities() const override { return {true, true, true, true}; }
    RendererCosts costs() const override {
        const std::uint64_t film = film_.pixels.size() * sizeof(shared::FilmPixel) +
                                   film_.moments.size() * sizeof(shared::FilmMoments) +
                                   film_.first_hits.size() * sizeof(shared::FilmFirstHit);
        return {.build_seconds = build_seconds_,
                .bytes = buffer_bytes(*packed_) + scene_->bytes() + film + reuse_.bytes(),
                .acceleration_bytes = scene_->bytes(),
                .pass_bytes = reuse_.bytes()};
    }

    void render(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) override {
        const Stopwatch watch;
        const std::uint32_t step = resamples() ? 1 : samples_a_slice;
        for (std::uint32_t done = 0; done < count && !cancel; done += step) {
            if (resamples()) {
                render_frame(film_, first + done);
            } else {
                accumulate(film_, first + done, std::min(step, count - done), &cancel);
            }
        }
        seconds_ += watch.seconds();
    }

    void restart(std::uint32_t seed) override {
        constants_.seed = seed;
        schedule_.restart();
        clear_film();
    }

    void clear_film() override {
        const std::size_t pixels = static_cast<std::size_t>(film_.width) * static_cast<std::size_t>(film_.height);
        film_.pixels.assign(pixels, {});
        film_.moments.assign((packed_->features & shared::FEATURE_STANDARD_ERROR) != 0 ? pixels : 0, {});
        film_.first_hits.assign((packed_->features & shared::FEATURE_FIRST_HIT_LAYERS) != 0 ? pixels : 0, {});
    }

    void move_to(const PackedScene& moment) override {
        run_in(arena_, [&] { scene_->move_to(moment); });
        const std::uint32_t seed = constants_.seed;
        packed_ = &moment;
        constants_ = moment.constants;
        constants_.seed = seed;
    }

    void reconfigure(const PackedScene& packed) override {
        run_in(arena_, [&] { scene_->reconfigure(packed); });
        packed_ = &packed;
        constants_ = packed.constants;
        lay_out_films();
    }

    double device_seconds() const override { return seconds_; }
    std::vector<PassTime> pass_times() const override { return passes_; }
    void watch_reservoirs(ReservoirHook hook) override { hook_ = std::move(hook); }
    Film film() const override { return film_; }
    std::shared_ptr<const Film> film_in_place() const override { return {std::shared_ptr<void>(), &film_}; }
    TraversalBench bench_traversal(std::uint32_t samples) override;

    std::vector<RecordedPath> record_paths(std::span<const shared::PathQuery> queries,
                                           std::optional<std::uint32_t> seed) override {
        shared::RenderConstants constants = constants_;
        constants.seed = seed.value_or(constants.seed);
        return run_in(arena_, [&] { return core::record_paths(*packed_, constants, *scene_, queries); });
    }
    std::vector<shared::PathSummary> summarize_paths(std::span<const shared::PathQuery> queries) override {
        return run_in(arena_, [&] { return core::summarize_paths(*packed_, constants_, *scene_, queries); });
    }

private:
    /// Empty, as the packed scene's settings want them; times of passes count from 0.
    void lay_out_films() {
        film_.width = static_cast<int>(constants_.size.x);
        film_.height = static_cast<int>(constants_.size.y);
        clear_film();
        reuse_ = ResamplingFilms(constants_);
        schedule_ = ResamplingSchedule(constants_);
        passes_.clear();
        for (const std::string& pass : pass_names(constants_)) {
            passes_.push_back({pass});
        }
    }

    template <class Body>
    void for_tiles(const Body& body) const {
        const tbb::blocked_range2d<int> tiles(0, (film_.height + tile_size - 1) / tile_size, 1, 0,
                                              (film_.width + tile_size - 1) / tile_size, 1);
        run_in(arena_, [&] {
            parallel_over(
                tiles,
                [&](const tbb::blocked_range2d<int>& range) {
                    for (int y = range.rows().begin(); y < range.rows().end(); ++y) {
                        for (int x = range.cols().begin(); x < range.cols().end(); ++x) {
                            body(x, y);
                        }
                    }
                },
                tbb::simple_partitioner());
        });
    }

    /// One pixel of a film; layers that are left out go nowhere.
    struct FilmEntry {
        shared::FilmPixel& pixel;
        shared::FilmMoments& moments;
        shared::FilmFirstHit& first_hit;
    };

    struct FilmEntries {
        Film& film;
        shared::FilmMoments no_moments{};
        shared::FilmFirstHit no_first_hit{};

        FilmEntry at(int x, int y) {
            const std::size_t i =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(film.width) + static_cast<std::size_t>(x);
            return {film.pixels[i], film.moments.empty() ? no_moments : film.moments[i],
                    film.first_hits.empty() ? no_first_hit : film.first_hits[i]};
        }
    };

    template <class Body>
    static void for_pixels(Film& film, int tile_x, int tile_y, const Body& body) {
        FilmEntries entries{film};
        for (int y = tile_y * tile_size; y < std::min((tile_y + 1) * tile_size, film.height); ++y) {
            for (int x = tile_x * tile_size; x < std::min((tile_x + 1) * tile_size, film.width); ++x) {
                body(shared::uvec2(x, y), entries.at(x, y));
            }
        }
    }

    template <class Kernel>
    void accumulate_tile(Kernel& kernel, Film& film, int tile_x, int tile_y, std::uint32_t first,
                         std::uint32_t count) const {
        FilmEntries entries{film};
        PathBatch<Kernel> batch(kernel);
        static_assert(batch.size == tile_size);
        const int left = tile_x * tile_size;
        const int columns = std::min(tile_size, film.width - left);
        for (int y = tile_y * tile_size; y < std::min((tile_y + 1) * tile_size, film.height); ++y) {
            for (std::uint32_t sample = first; sample < first + count; ++sample) {
                batch.trace(static_cast<std::uint32_t>(left), static_cast<std::uint32_t>(y), columns, sample);
                for (int x = 0; x < columns; ++x) {
                    const FilmEntry entry = entries.at(left + x, y);
                    kernel.add_path(batch.found(x), entry.pixel, entry.moments, entry.first_hit);
                }
            }
        }
    }

    bool resamples() const { return shared::resamples_lights(constants_.integrator); }

    /// One sample of every pixel, pass by pass. A frame is not cut short, or its reservoirs would be of two frames.
    void render_frame(Film& film, std::uint32_t frame) {
        for (const ResamplingStep& step : schedule_.next_frame(frame)) {
            const Stopwatch watch;
            for_tiles([&](int tile_x, int tile_y) {
                shared::CpuKernel<PlainTracer, ~0U> kernel{*packed_, constants_, {*scene_}, &reuse_};
                for_pixels(film, tile_x, tile_y, [&](shared::uvec2 pixel, FilmEntry entry) {
                    if (step.stage == ResamplingStage::shade) {
                        kernel.add_path(kernel.shade_resampled(pixel, step.pass), entry.pixel, entry.moments,
                                        entry.first_hit);
                    } else {
                        run_stage(kernel, step, pixel);
                    }
                });
            });
            passes_[step.place].seconds += watch.seconds();
            if (hook_) {
                hook_(step, std::span(reuse_.reservoirs).subspan(resulting_set(step) * reuse_.pixels, reuse_.pixels));
            }
        }
    }

    void accumulate(Film& film, std::uint32_t first, std::uint32_t count, const std::atomic<bool>* cancel) const {
        const std::uint32_t features = packed_->features;
        const bool has_tree = (features & tree) != 0;
        const bool diffuse = (features & ~(diffuse_features | tree)) == 0;
        const bool plain = (features & ~(plain_features | tree)) == 0;
        for_tiles([&](int x, int y) {
            if (cancel != nullptr && *cancel) {
                return;
            }
            if (diffuse && !has_tree) {
                accumulate_flat_tile<diffuse_features>(film, x, y, first, count);
            } else if (diffuse) {
                accumulate_flat_tile<diffuse_features | tree>(film, x, y, first, count);
            } else if (plain && !has_tree) {
                accumulate_flat_tile<plain_features>(film, x, y, first, count);
            } else if (plain) {
                accumulate_flat_tile<plain_features | tree>(film, x, y, first, count);
            } else {
                shared::CpuKernel<PlainTracer, ~0U> kernel{*packed_, constants_, {*scene_}};
                accumulate_tile(kernel, film, x, y, first, count);
            }
        });
    }

    /// One function with everything inlined, so that what a path carries along stays in registers.
    template <std::uint32_t FEATURES>
    [[gnu::flatten, gnu::noinline]] void accumulate_flat_tile(Film& film, int tile_x, int tile_y, std::uint32_t first,
                                                              std::uint32_t count) const {
        shared::CpuKernel<PlainTracer, FEATURES> kernel{*packed_, constants_, {*scene_}};
        accumulate_tile(kernel, film, tile_x, tile_y, first, count);
    }

    const PackedScene* packed_;
    shared::RenderConstants constants_;
    mutable tbb::task_arena arena_;
    Stopwatch building_;
    std::unique_ptr<EmbreeScene> scene_;
    Film film_;
    ResamplingFilms reuse_;
    ResamplingSchedule schedule_{constants_};
    std::vector<PassTime> passes_;
    ReservoirHook hook_;
    double build_seconds_ = 0;
    double seconds_ = 0;
};

TraversalBench CpuRenderer::bench_traversal(std::uint32_t samples) {
    constexpr int repeats = 5;
    const int columns = (film_.width + tile_size - 1) / tile_size;
    const int rows = (film_.height + tile_size - 1) / tile_size;
    std::vector<std::vector<TracedRay>> rays(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    const auto of_tile = [&](int x, int y) -> std::vector<TracedRay>& {
        return rays[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x)];
    };
    Film scratch = film_;
    for_tiles([&](int x, int y) {
        shared::CpuKernel<RecordingTracer, ~0U> kernel{*packed_, constants_, {*scene_, of_tile(x, y)}};
        accumulate_tile(kernel, scratch, x, y, 0, samples);
    });

    TraversalBench bench;
    for (const std::vector<TracedRay>& tile : rays) {
        bench.rays += tile.size();
    }
    std::vector<double> integrator;
    std::vector<double> bare;
    std::atomic<std::uint64_t> hits{0};  // keeps the compiler from dropping the queries
    for (int i = 0; i < repeats; ++i) {
        Stopwatch watch;
        accumulate(scratch, 0, samples, nullptr);
        integrator.push_back(watch.seconds());
        watch = Stopwatch();
        for_tiles([&](int x, int y) {
            std::uint64_t found = 0;
            for (const TracedRay& ray : of_tile(x, y)) {
                found +=
                    ray.any
                        ? static_cast<std::uint64_t>(scene_->any(ray.origin, ray.direction, ray.t_max, ray.alpha_key))
                        : scene_->closest(ray.origin, ray.direction, ray.alpha_key).instance;
            }
            hits += found;
        });
        bare.push_back(watch.seconds());
    }
    std::sort(integrator.begin(), integrator.end());
    std::sort(bare.begin(), bare.end());
    bench.integrator_seconds = integrator[repeats / 2];
    bench.bare_seconds = bare[repeats / 2];
    return bench;
}

}  // namespace

std::unique_ptr<Renderer> make_cpu_renderer(const PackedScene& packed, int threads) {
    return std::make_unique<CpuRenderer>(packed, threads);
}

std::string cpu_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        const std::size_t colon = line.find(": ");
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
            return line.substr(colon + 2);
        }
    }
    return "CPU";
}

}  // namespace diptych::core
