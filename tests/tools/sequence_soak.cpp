// A long sequence takes no more memory than a short one.
#include "catch.h"

#include <filesystem>
#include <fmt/format.h>
#include <string>
#include <vector>

#include "../common/temporary_folder.h"
#include "../memory_use.h"
#include "backends/backends.h"
#include "commands/program.h"
#include "error.h"
#include "session/make_renderer.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// Memory in use when frame number `first` and frame number `last` of a sequence begin.
struct Looks {
    int first = 0;
    int last = 0;
    int frame = 0;
    MemoryUse at_first;
    MemoryUse at_last;

    void next_frame() {
        if (frame == first) {
            at_first = memory_use();
        } else if (frame == last) {
            at_last = memory_use();
        }
        ++frame;
    }
};

/// The backend's own renderer; every frame begins with a restart, or with clear_film where frames are chained.
class WatchedRenderer final : public Renderer {
public:
    WatchedRenderer(std::unique_ptr<Renderer> renderer, Looks& looks) : renderer_(std::move(renderer)), looks_(looks) {}
    std::string backend() const override { return renderer_->backend(); }
    std::string device() const override { return renderer_->device(); }
    RendererCosts costs() const override { return renderer_->costs(); }
    Capabilities capabilities() const override { return renderer_->capabilities(); }
    void render(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) override {
        renderer_->render(first, count, cancel);
    }
    void restart(std::uint32_t seed) override {
        looks_.next_frame();
        renderer_->restart(seed);
    }
    void clear_film() override {
        looks_.next_frame();
        renderer_->clear_film();
    }
    void move_to(const PackedScene& moment) override { renderer_->move_to(moment); }
    double device_seconds() const override { return renderer_->device_seconds(); }
    std::vector<PassTime> pass_times() const override { return renderer_->pass_times(); }
    Film film() const override { return renderer_->film(); }
    std::shared_ptr<const Film> film_in_place() const override { return renderer_->film_in_place(); }
    TraversalBench bench_traversal(std::uint32_t samples) override { return renderer_->bench_traversal(samples); }

private:
    std::unique_ptr<Renderer> renderer_;
    Looks& looks_;
};

bool can_open(const std::string& backend) {
    const TemporaryFolder folder;
    std::vector<std::string> words = {"diptych", "render", DIPTYCH_SOURCE_DIR "/scenes/moving-light.gltf", "--backend",
                                      backend,   "--size", "8",  "--spp", "1", "-o", (folder / "probe.png").string()};
    std::vector<char*> arguments;
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    return app::run_program(static_cast<int>(arguments.size()), arguments.data()) == 0;
}

/// Bytes a frame by which the memory grows over the last three quarters of a sequence.
MemoryUse growth_a_frame(const std::string& backend, const std::string& integrator, int frames) {
    const TemporaryFolder folder;
    Looks looks;
    looks.first = frames / 4;
    looks.last = frames - 1;
    app::replace_renderers([&](const Scene& scene, const PackedScene& packed, const RenderRequest& request) {
        return std::make_unique<WatchedRenderer>(app::open_renderer(scene, packed, request), looks);
    });
    std::vector<std::string> words = {"diptych",   "render", DIPTYCH_SOURCE_DIR "/scenes/moving-light.gltf",
                                      "--backend", backend,  "--integrator",
                                      integrator,  "--size", "8",
                                      "--spp",     "1",      "--frames",
                                      std::to_string(frames), "-o", (folder / "f.exr").string()};
    std::vector<char*> arguments;
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    const int code = app::run_program(static_cast<int>(arguments.size()), arguments.data());
    app::replace_renderers({});
    REQUIRE(code == 0);
    REQUIRE(looks.frame >= frames);
    const double between = looks.last - looks.first;
    return {(looks.at_last.allocated - looks.at_first.allocated) / between,
            (looks.at_last.resident - looks.at_first.resident) / between};
}

void check_no_growth(const std::string& backend, int frames) {
    const std::string integrator = GENERATE("path", "restir");
    const MemoryUse growth = growth_a_frame(backend, integrator, frames);
    fmt::print("{} {}: {} frames, bytes a frame: allocated {:.1f}, resident {:.1f}\n", backend, integrator, frames,
               growth.allocated, growth.resident);
    CHECK(growth.allocated < 16);
    // The kernel gives pages, and free blocks between others stay: a few hundred kB in all.
    CHECK(growth.resident < 16 + 1e6 / frames);
}

}  // namespace

TEST_CASE("500 frames of a sequence take no more memory than 125") {
    if (!measures_memory()) {
        SKIP_TEST("sanitizers keep what is freed");
    }
    check_no_growth("cpu", 500);
}

TEST_CASE("30,000 frames of a sequence take no more memory than 7,500", "[nightly]") {
    if (!measures_memory()) {
        SKIP_TEST("sanitizers keep what is freed");
    }
    const std::string backend = GENERATE("cpu", "vulkan");
    if (!can_open(backend)) {
        SKIP_TEST("no Vulkan device with ray tracing");
    }
    check_no_growth(backend, 30000);
}
