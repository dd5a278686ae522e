// A device that runs out of memory says so, works in smaller parts where it can, and keeps nothing of what failed.
#include "commands/commands.h"
#include "device/heap_room.h"
#include "error.h"
#include "gpu_fixture.h"
#include "memory/upload.h"
#include "renderer/memory_plan.h"
#include "renderer/path_renderer.h"

#include <regex>

namespace diptych::core::tests {
namespace {

constexpr std::uint64_t kilobyte = 1024;

RenderSettings memory_settings(Integrator integrator, int size) {
    RenderSettings settings;
    settings.width = settings.height = size;
    settings.max_depth = 2;
    settings.integrator = integrator;
    settings.standard_error = settings.first_hit_layers = true;
    return settings;
}

/// A scene that needs memory for every purpose of a renderer.
PackedScene full_scene(int size) {
    PackedScene packed = generated_scene("cornell", memory_settings(Integrator::ris, size));
    packed.texels.assign(4096, 0);
    return packed;
}

Film render_all(const std::shared_ptr<Gpu>& gpu, const PackedScene& packed, std::uint32_t samples = 2) {
    const std::atomic<bool> cancel = false;
    PathRenderer renderer(gpu, packed);
    renderer.render(0, samples, cancel);
    return renderer.film();
}

/// Bytes of everything but pipelines, which the device keeps for other renderers.
std::uint64_t bytes_in_use(const Gpu& gpu) {
    BytesByPurpose bytes = gpu.memory_use->bytes();
    bytes[static_cast<std::size_t>(Purpose::pipelines)] = 0;
    return total(bytes);
}

std::string refusal_of(const std::function<void()>& work) {
    try {
        work();
    } catch (const OutOfMemory& error) {
        return error.what();
    }
    return "nothing was thrown";
}

/// The plan is a lower bound of what a renderer of the scene holds.
void check_plan(const std::shared_ptr<Gpu>& gpu, const PackedScene& packed) {
    const MemoryPlan plan = plan_memory(*gpu, packed, {});
    const PathRenderer renderer(gpu, packed);
    const BytesByPurpose held = gpu->memory_use->bytes();
    for (const Purpose purpose :
         {Purpose::textures, Purpose::vertices, Purpose::tables, Purpose::reservoirs, Purpose::paths_in_flight}) {
        INFO(name_of(purpose));
        const auto place = static_cast<std::size_t>(purpose);
        CHECK(plan.rendering[place] > 0);
        CHECK(plan.rendering[place] <= held[place]);
        // Drivers round allocations up.
        CHECK((purpose == Purpose::paths_in_flight || held[place] < plan.rendering[place] + 64 * kilobyte));
    }
    const auto film = static_cast<std::size_t>(Purpose::film);
    CHECK(plan.rendering[film] > 0);
    CHECK(plan.rendering[film] <= held[film] * (gpu->on_cpu ? 4 : 1));
    CHECK(plan.building[static_cast<std::size_t>(Purpose::structures)] > 0);
    CHECK(total(held) <= heap_room(*gpu, largest_heap(*gpu)).size);
}

}  // namespace

TEST_CASE("Out of memory: each purpose is named, and nothing is left behind") {
    NEED_VULKAN();
    const std::shared_ptr<Gpu> gpu = open_test_gpu();
    const PackedScene packed = full_scene(16);
    // Pipelines first: the device keeps them.
    for (const Purpose purpose :
         {Purpose::pipelines, Purpose::film, Purpose::reservoirs, Purpose::paths_in_flight, Purpose::structures,
          Purpose::structure_scratch, Purpose::textures, Purpose::vertices, Purpose::tables, Purpose::staging,
          Purpose::readback}) {
        INFO(name_of(purpose));
        gpu->faults.allocation = [&](Purpose asked, std::uint64_t) { return asked == purpose; };
        const std::string refusal = refusal_of([&] { render_all(gpu, packed, 1); });
        INFO(refusal);
        CHECK(refusal.find("Vulkan device " + gpu->name + ": out of memory: ") == 0);
        CHECK(refusal.find(std::string(" for ") + name_of(purpose) + " (a test); in use: ") != std::string::npos);
        CHECK(std::regex_search(refusal, std::regex("free: [0-9.]+ [kMGT]?B of [^;]+; ")));
        CHECK(bytes_in_use(*gpu) == 0);
    }
    gpu->faults.allocation = {};
    CHECK(render_all(gpu, packed, 1).pixels[0].samples == 1);  // the device goes on
    CHECK(bytes_in_use(*gpu) == 0);
    check_plan(gpu, packed);
    check_no_validation_messages();
}

TEST_CASE("Recorded paths that find no memory leave the renderer as it was", "[nightly]") {
    NEED_VULKAN();
    const std::shared_ptr<Gpu> gpu = open_test_gpu();
    const PackedScene packed = generated_scene("cornell", memory_settings(Integrator::path, 16));
    const std::atomic<bool> cancel = false;
    PathRenderer renderer(gpu, packed);
    const std::vector<shared::PathQuery> query = {{{3, 4}, 0}};
    gpu->faults.allocation = [](Purpose asked, std::uint64_t) { return asked == Purpose::recorded_paths; };
    CHECK(refusal_of([&] { renderer.record_paths(query); }).find("for recorded paths") != std::string::npos);
    gpu->faults.allocation = {};
    renderer.render(0, 2, cancel);
    CHECK(same_film(renderer.film(), render_all(gpu, packed)));
    CHECK(renderer.record_paths(query).size() == 1);
    check_no_validation_messages();
}

namespace {

void check_same_picture_with_little_memory(Integrator integrator) {
    const std::shared_ptr<Gpu> gpu = open_test_gpu();
    const PackedScene packed = generated_scene("cornell", memory_settings(integrator, 80));
    const Film expected = render_all(gpu, packed);
    std::uint64_t most_paths = 0, most_staging = 0, most_readback = 0;
    int structures = 0;
    gpu->faults.allocation = [&](Purpose asked, std::uint64_t bytes) {
        switch (asked) {
        case Purpose::paths_in_flight:
            most_paths = bytes <= fewest_paths * sizeof(shared::WavePath) ? std::max(most_paths, bytes) : most_paths;
            return bytes > fewest_paths * sizeof(shared::WavePath);
        case Purpose::staging:
            most_staging = bytes <= 64 * kilobyte ? std::max(most_staging, bytes) : most_staging;
            return bytes > 64 * kilobyte;
        case Purpose::readback:
            most_readback = bytes <= 128 * kilobyte ? std::max(most_readback, bytes) : most_readback;
            return bytes > 128 * kilobyte;
        case Purpose::structures:
            return ++structures == 1;  // the batch of all meshes
        default:
            return false;
        }
    };
    CHECK(same_film(render_all(gpu, packed), expected));
    gpu->faults.allocation = {};
    CHECK(most_paths > 0);
    CHECK(most_staging > 0);
    CHECK(most_readback > 0);
    CHECK(structures >= 5);  // two halves, each built and compacted, and the top level
    check_no_validation_messages();
}

}  // namespace

TEST_CASE("With little memory there are fewer paths in flight, less staging and smaller builds, and the same picture") {
    NEED_VULKAN();
    check_same_picture_with_little_memory(Integrator::path);
}

TEST_CASE("With little memory resampling gives the same picture", "[nightly]") {
    NEED_VULKAN();
    check_same_picture_with_little_memory(GENERATE(Integrator::ris, Integrator::restir));
}

TEST_CASE("A structure without room for its compacted copy stays as it was built") {
    NEED_VULKAN();
    const std::shared_ptr<Gpu> gpu = open_test_gpu();
    const PackedScene packed = random_scene(7, 1, 1, 50);
    const SceneMemory scene = upload_scene(*gpu, packed);
    int structures = 0;
    gpu->faults.allocation = [&](Purpose asked, std::uint64_t) {
        return asked == Purpose::structures && ++structures == 2;
    };
    const BottomLevels levels = build_bottom_levels(*gpu, packed, scene, {});
    CHECK(structures == 2);
    CHECK(levels.addresses.at(0) != 0);
    CHECK(levels.bytes == levels.built_bytes);
    const TopLevel top = build_top_level(*gpu, packed, levels);
    check_no_validation_messages();
}

TEST_CASE("A picture too large for the device is refused before anything is allocated, with the size that fits") {
    NEED_VULKAN();
    const std::shared_ptr<Gpu> gpu = open_test_gpu();
    gpu->faults.memory = std::uint64_t{32} << 20U;
    int allocations = 0;
    gpu->faults.allocation = [&](Purpose, std::uint64_t) {
        ++allocations;
        return false;
    };
    const auto packed_at = [&](int size, bool layers) {
        RenderSettings settings = memory_settings(Integrator::path, size);
        settings.standard_error = settings.first_hit_layers = layers;
        return generated_scene("cornell", settings);
    };
    const std::string refusal = refusal_of([&] { render_all(gpu, packed_at(280, true)); });
    INFO(refusal);
    CHECK(allocations == 0);
    CHECK(refusal.find(" at once: the film ") != std::string::npos);
    CHECK(refusal.find("of 32.0 MB; ") != std::string::npos);
    CHECK(refusal.find("without `layers`") != std::string::npos);
    std::smatch found;
    REQUIRE(std::regex_search(refusal, found, std::regex("a `size` of ([0-9]+)x([0-9]+) would fit")));
    const int side = std::stoi(found[1]);
    CHECK(side > 150);
    const std::uint32_t features = packed_at(280, true).features;
    // One more pixel a side would not fit.
    CHECK_FALSE(refusal_of([&] { require_memory(*gpu, packed_at(side + 1, true), {}); }) == "nothing was thrown");
    CHECK(refusal_of([&] { require_memory(*gpu, packed_at(side, true), {}); }) == "nothing was thrown");
    CHECK(refusal_of([&] { require_memory(*gpu, packed_at(280, false), {}); }) == "nothing was thrown");
    CHECK(film_bytes(std::uint64_t{280} * 280, features) < (std::uint64_t{32} << 20U));  // copies on the host count too
    check_no_validation_messages();
}

}  // namespace diptych::core::tests
