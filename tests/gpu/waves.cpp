// Paths in waves: how many are in flight, and that all come to their end.
#include "passes/path_waves.h"

#include "backend/cpu_renderer.h"
#include "gpu_fixture.h"
#include "renderer/path_renderer.h"

namespace diptych::core::tests {
namespace {

Film render_film(Renderer& renderer, std::uint32_t samples) {
    const std::atomic<bool> cancel = false;
    renderer.render(0, samples, cancel);
    return renderer.film();
}

}  // namespace

TEST_CASE("Paths longer than a submission has waves go on in the next, and no longer than there are any") {
    NEED_VULKAN();
    RenderSettings settings;
    settings.width = 24;
    settings.height = 24;
    settings.max_depth = 100000;
    settings.integrator = GENERATE(Integrator::path, Integrator::ris);
    const PackedScene packed = generated_scene("extreme-white-room", settings);
    PathRenderer on_device(packed, test_options());
    const std::unique_ptr<Renderer> on_host = make_cpu_renderer(packed, 0);
    const Film film = render_film(on_device, 32);
    const FilmTotals device = film_totals(film);
    const FilmTotals host = film_totals(render_film(*on_host, 32));
    REQUIRE(host.samples == 24 * 24 * 32);
    CHECK(device.samples == host.samples);
    // Cut off after the first submission they would lack more than a thousandth.
    CHECK(static_cast<double>(device.rays) == Approx(static_cast<double>(host.rays)).epsilon(1e-4));
    check_no_validation_messages();
}

TEST_CASE("Paths in flight: as many as are to be traced, within bounds") {
    NEED_VULKAN();
    const std::shared_ptr<Gpu> gpu = open_test_gpu();
    const std::uint32_t fewest = path_capacity(*gpu, 1);
    const std::uint32_t most = path_capacity(*gpu, std::uint64_t{1} << 40U);
    CHECK(fewest == 1U << 16U);
    CHECK(most >= fewest);
    CHECK(most <= 1U << 22U);
    CHECK(path_capacity(*gpu, most) == most);
    CHECK(path_capacity(*gpu, (fewest + most) / 2) == (fewest + most) / 2);

    RenderSettings settings;
    settings.width = settings.height = 8;
    const auto bytes_with = [&](Integrator integrator, std::uint32_t depth) {
        settings.integrator = integrator;
        settings.max_depth = depth;
        return PathRenderer(gpu, generated_scene("cornell", settings)).costs().pass_bytes;
    };
    // Shadow rays have no room where no light is sampled, and resampled direct light has no path to follow.
    const std::uint64_t of_path = bytes_with(Integrator::path, 3);
    CHECK(of_path - bytes_with(Integrator::brdf, 3) == std::uint64_t{fewest} * sizeof(shared::WaveShadow));
    const std::uint64_t of_ris = bytes_with(Integrator::ris, 1);
    CHECK(bytes_with(Integrator::ris, 3) - of_ris == of_path);
    settings.resampling.bsdf_candidate = false;  // then no list of those that need rays, which begins with an indirect command
    CHECK(of_ris - bytes_with(Integrator::ris, 1) == 3 * sizeof(std::uint32_t) + std::uint64_t{64} * sizeof(shared::CandidateRequest));
}

TEST_CASE("A small picture has several samples of each pixel in flight, and keeps its bits") {
    NEED_VULKAN();
    RenderSettings settings;
    settings.width = settings.height = 16;
    settings.max_depth = 2;
    const PackedScene packed = generated_scene("cornell", settings);
    PathRenderer few(packed, test_options(), {.slice_budget = 4096});
    PathRenderer many(packed, test_options(), {.slice_budget = 1U << 20U, .fill = DeviceFill::anywhere});
    const std::uint64_t bytes = few.costs().pass_bytes;
    const Film first = render_film(few, 300);
    CHECK(few.costs().pass_bytes == bytes);
    CHECK(many.costs().pass_bytes == bytes);  // no more than are asked for
    CHECK(same_film(render_film(many, 300), first));
    CHECK(many.costs().pass_bytes > bytes);
    const std::uint64_t grown = many.costs().pass_bytes;
    many.restart(0);
    CHECK(same_film(render_film(many, 300), first));
    CHECK(many.costs().pass_bytes == grown);
    check_no_validation_messages();
}

}  // namespace diptych::core::tests
