// The seeds that commands really give to renderers: each command runs on renderers that note them.
#include "catch.h"

#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "../common/image_fixtures.h"
#include "session/make_renderer.h"
#include "backend/cpu_renderer.h"
#include "commands/program.h"
#include "settings/names.h"

using namespace diptych::core;
using diptych::core::image_tests::TemporaryFolder;

namespace {

/// Samples that were drawn from one seed without another restart between them: a picture, or a chain of pictures.
struct Stream {
    std::string side;  // backend, integrator, sampler
    std::uint32_t seed = 0;
    std::uint32_t samples = 0;
};

/// Of all renderers of a command, which may run in several threads.
class Log {
public:
    std::size_t begin(const Stream& stream) {
        const std::lock_guard lock(mutex_);
        streams_.push_back(stream);
        return streams_.size() - 1;
    }
    void draw(std::size_t stream, std::uint32_t samples) {
        const std::lock_guard lock(mutex_);
        streams_[stream].samples += samples;
    }
    std::vector<Stream> drawn() const {
        std::vector<Stream> drawn;
        for (const Stream& stream : streams_) {
            if (stream.samples > 0) {
                drawn.push_back(stream);
            }
        }
        return drawn;
    }

private:
    std::mutex mutex_;
    std::vector<Stream> streams_;
};

/// The CPU's renderer, whatever the backend, with its draws noted. Pictures of `path` are brighter by 1000, so that
/// every comparison with another integrator fails and goes on to its second stage.
class NotedRenderer final : public Renderer {
public:
    NotedRenderer(Log& log, const PackedScene& packed, const RenderRequest& request)
        : log_(log), renderer_(make_cpu_renderer(packed, 1)),
          brighter_(request.settings.integrator == Integrator::path),
          side_(request.backend + "/" + name_of(request.settings.integrator) + "/" + name_of(request.settings.sampler)),
          seed_(packed.constants.seed) {
        stream_ = log_.begin({side_, seed_});
    }
    std::string backend() const override { return renderer_->backend(); }
    std::string device() const override { return renderer_->device(); }
    Capabilities capabilities() const override { return {true, true, false, false}; }
    RendererCosts costs() const override { return renderer_->costs(); }
    void render(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) override {
        log_.draw(stream_, count);
        renderer_->render(first, count, cancel);
    }
    void restart(std::uint32_t seed) override {
        seed_ = seed;
        stream_ = log_.begin({side_, seed});
        renderer_->restart(seed);
    }
    void clear_film() override { renderer_->clear_film(); }
    void move_to(const PackedScene& moment) override { renderer_->move_to(moment); }
    double device_seconds() const override { return renderer_->device_seconds(); }
    Film film() const override {
        Film film = renderer_->film();
        for (shared::FilmPixel& pixel : film.pixels) {
            if (brighter_) {
                shared::exact_add(pixel.sum, glm::vec3(1000.0F * static_cast<float>(pixel.samples)));
            }
        }
        return film;
    }
    TraversalBench bench_traversal(std::uint32_t samples) override { return renderer_->bench_traversal(samples); }
    std::vector<shared::PathSummary> summarize_paths(std::span<const shared::PathQuery> queries) override {
        log_.begin({side_, seed_, 1});
        return renderer_->summarize_paths(queries);
    }

private:
    Log& log_;
    std::unique_ptr<Renderer> renderer_;
    bool brighter_;
    std::string side_;
    std::uint32_t seed_;
    std::size_t stream_ = 0;
};

int run(std::vector<std::string> words) {
    words.insert(words.begin(), "diptych");
    std::vector<char*> arguments;
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    return app::run_program(static_cast<int>(arguments.size()), arguments.data());
}

/// What a command draws, sample count apart.
std::vector<Stream> draws_of(const std::vector<std::string>& words) {
    Log log;
    app::replace_renderers([&](const Scene&, const PackedScene& packed, const RenderRequest& request) {
        return std::make_unique<NotedRenderer>(log, packed, request);
    });
    const int code = run(words);
    app::replace_renderers({});
    CHECK(code <= 1);  // 1: verify has seen the difference that it was given
    return log.drawn();
}

std::string scene_in(const TemporaryFolder& folder, const std::string& name) {
    const std::string path = (folder / (name + ".gltf")).string();
    REQUIRE(run({"generate", name, "-o", path}) == 0);
    return path;
}

std::set<std::uint32_t> seeds_of(const std::vector<Stream>& streams, const std::string& side = "") {
    std::set<std::uint32_t> seeds;
    for (const Stream& stream : streams) {
        if (stream.side.find(side) == 0) {
            seeds.insert(stream.seed);
        }
    }
    return seeds;
}

}  // namespace

TEST_CASE("verify gives every render a seed of its own, in both stages") {
    const TemporaryFolder folder;
    const std::vector<Stream> streams = draws_of({"verify",
                                                  scene_in(folder, "moving-light"),
                                                  "--backends",
                                                  "cpu",
                                                  "--integrators",
                                                  "brdf,path,restir",
                                                  "--against",
                                                  "cpu/path",
                                                  "--runs",
                                                  "3",
                                                  "--spp",
                                                  "4",
                                                  "--frame",
                                                  "0,2",
                                                  "--size",
                                                  "8",
                                                  "--tile",
                                                  "8",
                                                  "--fresh-seeds",
                                                  "--seed",
                                                  "5"});
    // Of two frames brdf, path and the reference render 3 runs each, restir plays 4 chains a run. What differs from
    // the reference comes again, with four times as many chains.
    constexpr std::size_t first = 3 * (2 + 2 + 2 + 4), second = 3 * (2 + 2 + 16);
    CHECK(streams.size() == first + second);
    CHECK(seeds_of(streams).size() == streams.size());
}

TEST_CASE("verify gives both sides of an A/A test seeds of their own, and common ones where asked") {
    const TemporaryFolder folder;
    const std::string scene = scene_in(folder, "cornell");
    const std::vector<std::string> common = {"verify", scene, "--integrators", "direct", "--runs", "5",
                                             "--spp",  "1",   "--size",        "8",      "--tile", "8"};
    std::vector<std::string> words = common;
    words.insert(words.end(), {"--backends", "cpu", "--against", "cpu"});
    const std::vector<Stream> apart = draws_of(words);
    CHECK(apart.size() == 10);
    CHECK(seeds_of(apart).size() == 10);
    words = common;
    words.insert(words.end(), {"--backends", "vulkan", "--against", "cpu", "--common-seeds"});
    const std::vector<Stream> together = draws_of(words);
    CHECK(together.size() == 10);
    CHECK(seeds_of(together).size() == 5);
    CHECK(seeds_of(together, "cpu") == seeds_of(together, "vulkan"));
}

TEST_CASE("A paired test traces both panels' paths under the seed that is given") {
    const TemporaryFolder folder;
    const std::vector<Stream> streams = draws_of({"verify", scene_in(folder, "cornell"), "--paired", "--integrators",
                                                  "direct", "--spp", "1", "--size", "8", "--seed", "77"});
    CHECK(streams.size() == 2);
    CHECK(seeds_of(streams) == std::set<std::uint32_t>{77});
}

TEST_CASE("converge gives methods, runs, pictures and blocks of the reference seeds of their own") {
    const TemporaryFolder folder;
    const std::vector<Stream> streams =
        draws_of({"converge", scene_in(folder, "cornell"), "--methods", "cpu:direct:independent,cpu:brdf:hammersley",
                  "--spp-max", "4", "--runs", "3", "--size", "16", "-o", (folder / "report").string()});
    // Three runs and a picture; the counts of a run share its seed, and so does what warms a renderer up.
    CHECK(seeds_of(streams, "cpu/direct/independent").size() == 4);
    CHECK(seeds_of(streams, "cpu/brdf/hammersley").size() == 4);
    CHECK(seeds_of(streams, "cpu/path/sobol").size() == 16);
    CHECK(seeds_of(streams).size() == 4 + 4 + 16);
}

TEST_CASE("Frames that render paints have neighbouring seeds, from the given one on") {
    const TemporaryFolder folder;
    const std::vector<Stream> streams =
        draws_of({"render", scene_in(folder, "moving-light"), "-o", (folder / "walk.exr").string(), "--frames", "3",
                  "--spp", "1", "--size", "8", "--seed", "5", "--json"});
    CHECK(streams.size() == 3);
    CHECK(seeds_of(streams) == std::set<std::uint32_t>{5, 6, 7});
}
