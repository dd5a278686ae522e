// Renderers and a display on one device, from threads of their own.
#include <atomic>
#include <cstring>
#include <thread>

#include "commands/commands.h"
#include "display/display_pass.h"
#include "gpu_fixture.h"
#include "renderer/path_renderer.h"

namespace diptych::core::tests {
namespace {

RenderSettings settings_of(Integrator integrator) {
    RenderSettings settings;
    settings.width = 32;
    settings.height = 24;
    settings.max_depth = 3;
    settings.integrator = integrator;
    return settings;
}

std::vector<shared::FilmPixel> shared_picture(Renderer& renderer) {
    const std::atomic<bool> cancel = false;
    renderer.restart(3);
    renderer.render(0, 6, cancel);
    return renderer.film().pixels;
}

bool same_pixels(const std::vector<shared::FilmPixel>& a, const std::vector<shared::FilmPixel>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

}  // namespace

TEST_CASE("Two renderers and a display on one device, each in its own thread, do what they do alone") {
    NEED_VULKAN();
    const PackedScene path_scene = generated_scene("cornell", settings_of(Integrator::path));
    const PackedScene restir_scene = generated_scene("cornell", settings_of(Integrator::restir));
    const auto alone = [](const PackedScene& packed) {
        PathRenderer renderer(packed, test_options());
        return shared_picture(renderer);
    };
    const std::vector<shared::FilmPixel> path_alone = alone(path_scene);
    const std::vector<shared::FilmPixel> restir_alone = alone(restir_scene);

    const std::shared_ptr<Gpu> gpu = open_test_gpu();
    PathRenderer path(gpu, path_scene, {.slice_budget = 200});
    PathRenderer restir(gpu, restir_scene, {.slice_budget = 200});
    shared_picture(path);
    shared_picture(restir);
    std::atomic<int> working = 2;
    std::atomic<int> wrong = 0;
    const auto work = [&](PathRenderer& renderer, const std::vector<shared::FilmPixel>& expected) {
        for (int i = 0; i < 4; ++i) {
            wrong += same_pixels(shared_picture(renderer), expected) ? 0 : 1;
        }
        --working;
    };
    std::thread path_worker(work, std::ref(path), std::cref(path_alone));
    std::thread restir_worker(work, std::ref(restir), std::cref(restir_alone));
    const DisplayPass pass = make_display_pass(*gpu);
    const DisplayPicture picture = make_display_picture(*gpu, pass, 64, 48);
    const DisplayRequest request{.left = path.device_film(), .right = restir.device_film(), .divider = 32};
    int frames = 0;
    do {
        run_commands(
            *gpu, [&](const vk::raii::CommandBuffer& commands) { record_display(commands, pass, picture, request); });
        ++frames;
    } while (working > 0);
    path_worker.join();
    restir_worker.join();
    CHECK(wrong == 0);
    CHECK(frames > 2);
    const Image last = read_display(*gpu, picture);
    CHECK(last.at(16, 24, 0) > 0);
    CHECK(last.at(48, 24, 0) > 0);
    check_no_validation_messages();
}

TEST_CASE("A film that is looked at stays as it is while the next picture begins") {
    NEED_VULKAN();
    for (const Integrator integrator : {Integrator::path, Integrator::restir}) {
        PathRenderer renderer(open_test_gpu(), generated_scene("cornell", settings_of(integrator)));
        const std::atomic<bool> cancel = false;
        const std::vector<shared::FilmPixel> first = shared_picture(renderer);
        const FilmMemory* shown = renderer.device_film().film.get();
        renderer.restart(3);  // nobody looks: the same memory again
        CHECK(renderer.device_film().film.get() == shown);
        renderer.render(0, 6, cancel);
        const DeviceFilm looked_at = renderer.device_film();
        renderer.restart(4);
        CHECK(renderer.film().pixels[0].samples == 0);
        renderer.render(0, 2, cancel);
        CHECK(renderer.device_film().film != looked_at.film);
        CHECK(renderer.film().pixels[0].samples == 2);
        const DeviceFilm second = renderer.device_film();
        renderer.clear_film();
        CHECK(renderer.device_film().film != second.film);
        CHECK(renderer.device_film().film != looked_at.film);
        CHECK(same_pixels(shared_picture(renderer), first));  // whichever film it lies in
    }
    check_no_validation_messages();
}

TEST_CASE("Dispatches of another length give the same picture") {
    NEED_VULKAN();
    RenderSettings settings = settings_of(Integrator::path);
    settings.width = settings.height = 96;
    const std::shared_ptr<Gpu> gpu = open_test_gpu();
    PathRenderer renderer(gpu, generated_scene("cornell", settings));
    const std::vector<shared::FilmPixel> expected = shared_picture(renderer);
    renderer.aim_dispatches(0.004);
    CHECK(same_pixels(shared_picture(renderer), expected));
    check_no_validation_messages();
}

TEST_CASE("A lost device is told from other errors") {
    const auto lose = [] { throw vk::DeviceLostError("a test"); };
    CHECK_THROWS_AS(in_context("testing", lose), DeviceLost);
    CHECK_THROWS_WITH(in_context("testing", lose), Catch::Contains("testing: the device is lost"));
    CHECK_THROWS_AS(in_context("outside", [&] { in_context("inside", lose); }), DeviceLost);
    const auto fail = [] { throw vk::OutOfDeviceMemoryError("a test"); };
    try {
        in_context("testing", fail);
        FAIL("nothing was thrown");
    } catch (const DeviceLost&) {
        FAIL("memory that ran out is no lost device");
    } catch (const Error&) {
    }
}

}  // namespace diptych::core::tests
