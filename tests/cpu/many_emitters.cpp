// Scenes of very many lights still pack and render.
#include <cstdio>
#include <ctime>

#include "render_fixture.h"
#include "generate/generate.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

void check_street(std::uint64_t count, double seconds_allowed) {
    GenerateOptions options;
    options.count = count;
    const Scene scene = generate_scene("many-lights", options).scene;
    const std::clock_t start = std::clock();  // of all threads, so that other load on the machine does not count
    RenderSettings settings = statistical_settings(32, 18, Integrator::path, 4);
    const PackedScene packed = pack_scene(scene, settings);
    CHECK(packed.constants.light_count >= count);
    CHECK(packed.emissive_triangles.size() >= count);
    // 64 bytes for the light, 8 for its table entry, and its geometry: some 200 in all.
    CHECK(buffer_bytes(packed) < 400 * count + 50'000'000);
    const auto renderer = make_cpu_renderer(packed, 2);
    const std::atomic<bool> cancel{false};
    renderer->render(0, 4, cancel);
    const Film film = renderer->film();
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::printf("many-lights %llu: packed, built and rendered in %.2f s of CPU, %.0f MB of buffers\n",
                static_cast<unsigned long long>(count), seconds, static_cast<double>(buffer_bytes(packed)) / 1e6);
    CHECK(film_totals(film).nonfinite == 0);
    CHECK(image_mean(film).mean[0] > 0);
    CHECK(seconds < seconds_allowed);
    double sum = 0;
    for (const shared::EmissiveTriangle& light : packed.emissive_triangles) {
        sum += static_cast<double>(light.pmf);
    }
    CHECK(sum == Approx(1).epsilon(1e-4));
}

}  // namespace

TEST_CASE("A street of a million lights packs and renders") {
    check_street(1'000'000, 60);
}
