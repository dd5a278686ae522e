#include "renderer/memory_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "language/scene_features.h"
#include "memory/film_memory.h"
#include "memory/out_of_memory.h"
#include "passes/path_waves.h"
#include "passes/resampling_passes.h"

namespace diptych::core {
namespace {

constexpr std::uint32_t layer_features = shared::FEATURE_STANDARD_ERROR | shared::FEATURE_FIRST_HIT_LAYERS;

std::uint64_t& at(BytesByPurpose& bytes, Purpose purpose) {
    return bytes[static_cast<std::size_t>(purpose)];
}

std::uint64_t pixels_of(const PackedScene& packed) {
    return std::uint64_t{packed.constants.size.x} * packed.constants.size.y;
}

/// A driver on the CPU shares the memory with the host: with the film that was read last and the next one, or with the
/// images that the film becomes.
std::uint64_t film_need(const Gpu& gpu, std::uint64_t pixels, std::uint32_t features) {
    return film_bytes(pixels, features) * (gpu.on_cpu ? 4 : 1);
}

/// The largest picture of that shape, and whether one without layers, for which there would be room.
std::string what_would_fit(const Gpu& gpu, const PackedScene& packed, BytesByPurpose need, std::uint64_t free) {
    const std::uint64_t pixels = pixels_of(packed);
    const std::uint64_t of_pixels = at(need, Purpose::film) + at(need, Purpose::reservoirs);
    const std::uint64_t rest = total(need) - of_pixels;
    const std::uint32_t bare = packed.features & ~layer_features;
    std::string advice;
    if (free > rest) {
        const double share = static_cast<double>(free - rest) / static_cast<double>(of_pixels);
        const auto side = [&](std::uint32_t length) {
            return static_cast<std::uint32_t>(std::floor(length * std::min(1.0, std::sqrt(share))));
        };
        if (side(packed.constants.size.x) > 0 && side(packed.constants.size.y) > 0) {
            advice = fmt::format("a `size` of {}x{} would fit", side(packed.constants.size.x),
                                 side(packed.constants.size.y));
        }
    }
    const std::uint64_t without_layers =
        total(need) - at(need, Purpose::film) + film_need(gpu, pixels, bare);
    if ((packed.features & layer_features) != 0 && without_layers <= free) {
        advice += fmt::format("{}this one would fit without `layers`", advice.empty() ? "" : ", and ");
    }
    return advice;
}

void require(const Gpu& gpu, const PackedScene& packed, const BytesByPurpose& need, const HeapRoom& room) {
    if (total(need) <= room.free) {
        return;
    }
    const auto largest = static_cast<Purpose>(std::max_element(need.begin(), need.end()) - need.begin());
    const std::string fits = what_would_fit(gpu, packed, need, room.free);
    refuse(gpu, fmt::format("{} at once: {}", size_text(total(need)), text_of(need)), room,
           fits.empty() ? what_needs_less(largest) : fits);
}

}  // namespace

MemoryPlan plan_memory(const Gpu& gpu, const PackedScene& packed, const InstanceGroups& groups) {
    BytesByPurpose scene = {};
#define ADD_BYTES(Type, name) at(scene, purpose_of_array(#name)) += std::span(packed.name).size_bytes();
    SCENE_BUFFERS(ADD_BYTES)
#undef ADD_BYTES
    MemoryPlan plan{.building = scene, .rendering = scene};
    const BuildBytes build = largest_build(gpu, packed, groups);
    at(plan.building, Purpose::structures) = build.structure;
    at(plan.building, Purpose::structure_scratch) = build.scratch;
    at(plan.rendering, Purpose::film) = film_need(gpu, pixels_of(packed), packed.features);
    at(plan.rendering, Purpose::reservoirs) = resampling_memory_bytes(packed.constants);
    at(plan.rendering, Purpose::paths_in_flight) = fewest_paths * wave_path_bytes(packed.features);
    return plan;
}

void require_memory(const Gpu& gpu, const PackedScene& packed, const InstanceGroups& groups) {
    const HeapRoom room = heap_room(gpu, largest_heap(gpu, vk::MemoryHeapFlagBits::eDeviceLocal));
    const MemoryPlan plan = plan_memory(gpu, packed, groups);
    require(gpu, packed, plan.building, room);
    require(gpu, packed, plan.rendering, room);
}

}  // namespace diptych::core
