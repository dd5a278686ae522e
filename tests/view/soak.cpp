// A view that is used for long takes no more memory than at its beginning.
#include <fmt/format.h>

#include "../common/temporary_folder.h"
#include "../memory_use.h"
#include "backend/cpu_renderer.h"
#include "view/frame_loop.h"
#include "view/picture_pass.h"
#include "view_fixture.h"

using namespace diptych::core;
using namespace diptych::core::app;
using namespace diptych::core::tests;

namespace {

RenderRequest request_of(const std::string& scene, const std::string& backend) {
    RenderRequest request;
    request.scene = scene;
    request.backend = backend;
    request.settings.width = 8;
    request.settings.height = 8;
    request.settings.max_depth = 2;
    return request;
}

/// Null where this machine has no device for it.
std::unique_ptr<PicturePass> open_pass(const RenderRequest& request) {
    try {
        return std::make_unique<PicturePass>(request);
    } catch (const Error&) {
        return nullptr;
    }
}

/// Steps the loop until `done`, for at most half a minute.
void step_until(FrameLoop& loop, double& now, const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!done()) {
        loop.step(now += 1);
        for (const std::string& error : loop.take_errors()) {
            FAIL(error);
        }
        REQUIRE(std::chrono::steady_clock::now() < end);
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
}

/// Opens two scenes in turn, each at two sizes, and shows every one.
void check_view_holds(const std::string& backend, int switches) {
    const TemporaryFolder folder;
    const std::string scenes[] = {DIPTYCH_SOURCE_DIR "/scenes/cornell.gltf", DIPTYCH_SOURCE_DIR "/scenes/moving-light.gltf"};
    const RenderRequest request = request_of(scenes[0], backend);
    const Panel panel = backend == "cpu" ? Panel::cpu : Panel::vulkan;
    const std::unique_ptr<PicturePass> pass = backend == "cpu" ? nullptr : open_pass(request);
    if (backend != "cpu" && !pass) {
        SKIP_TEST("no Vulkan device with ray tracing");
    }
    FrameLoopOptions panels;
    (panel == Panel::cpu ? panels.cpu : panels.vulkan) =
        pass ? pass->factory() : [](const PackedScene& packed) { return make_cpu_renderer(packed, 1); };
    FrameLoop loop(panels, load_scene(request, 1));
    loop.state().shown.panel = backend == "cpu" ? ShownPanel::cpu : ShownPanel::vulkan;
    double now = 10;
    const auto show = [&](int size) {
        RenderSettings& settings = loop.state().rendered.request.settings;
        settings.width = settings.height = size;
        loop.step(now += 1);
        step_until(loop, now, [&] {
            const auto shot = loop.shot(panel);
            return !shot->error.empty() || (shot->version == loop.version() && shot->spp > 0);
        });
        CHECK(loop.shot(panel)->error.empty());
        if (pass) {
            pass->draw(loop.state().shown, nullptr, loop.shot(panel).get(), size, size);
        }
    };
    MemoryUse begin;
    for (int i = 0; i < switches; ++i) {
        if (i == switches / 4) {
            begin = memory_use();
        }
        const std::uint64_t generation = loop.scene().generation;
        loop.open_scene(scenes[(i + 1) % 2]);
        step_until(loop, now, [&] { return loop.scene().generation != generation; });
        show(8);
        show(12);
    }
    const MemoryUse end = memory_use();
    const double counted = switches - switches / 4;
    const double allocated = (end.allocated - begin.allocated) / counted;
    const double resident = (end.resident - begin.resident) / counted;
    fmt::print("{}: {} switches, bytes a switch: allocated {:.1f}, resident {:.1f}\n", backend, switches, allocated,
               resident);
    CHECK(allocated < 64 + 1e5 / counted);
    CHECK(resident < 64 + 2e6 / counted);
}

}  // namespace

TEST_CASE("50 scenes and 100 sizes of a view leave no memory behind", "[view]") {
    if (!measures_memory()) {
        SKIP_TEST("sanitizers keep what is freed");
    }
    check_view_holds("cpu", 50);
}

TEST_CASE("2,000 scenes and 4,000 sizes of a view leave no memory behind", "[view][nightly]") {
    if (!measures_memory()) {
        SKIP_TEST("sanitizers keep what is freed");
    }
    const std::string backend = GENERATE("cpu", "vulkan");
    check_view_holds(backend, 2000);
}
