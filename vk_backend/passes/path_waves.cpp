#include "passes/path_waves.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

#include "film/film_pixel.h"
#include "geometry/hit.h"
#include "device/heap_room.h"
#include "memory/readback.h"
#include "language/scene_features.h"

namespace diptych::core {
namespace {

using Usage = vk::BufferUsageFlagBits;

constexpr std::uint64_t most_paths = std::uint64_t{1} << 22U;  // then the fixed cost of a wave is small
constexpr std::uint64_t fewest_wanted = std::uint64_t{1} << 16U;

constexpr std::uint64_t part_of_memory = 16;
constexpr std::uint32_t all_buffers = shared::FEATURE_FIRST_HIT_LAYERS | shared::FEATURE_LIGHT_SAMPLING;

constexpr Use counts_read{Resource::wave_counts, Unit::indirect, Effect::read};

std::uint64_t pixels_of(const shared::Dispatch& dispatch) {
    return std::uint64_t{dispatch.region.x} * dispatch.region.y;
}

bool keeps_first_hits(std::uint32_t features) {
    return (features & shared::FEATURE_FIRST_HIT_LAYERS) != 0;
}

bool samples_lights(std::uint32_t features) {
    return (features & shared::FEATURE_LIGHT_SAMPLING) != 0;
}

std::array<const Buffer*, 6> buffers_of(const WaveMemory& memory) {
    return {&memory.paths, &memory.first_hits, &memory.queues, &memory.hits, &memory.shadows, &memory.counts};
}

WaveMemory allocate_waves(const Gpu& gpu, std::uint32_t wanted, std::uint32_t capacity, std::uint32_t features) {
    const auto make = [&](std::uint64_t bytes, vk::BufferUsageFlags more = {}) {
        return make_buffer(gpu, Purpose::paths_in_flight, bytes,
                           Usage::eStorageBuffer | Usage::eShaderDeviceAddress | more, MemoryKind::device);
    };
    const std::uint64_t paths = capacity;
    return {.wanted = wanted,
            .capacity = capacity,
            .paths = make(paths * sizeof(shared::WavePath)),
            .first_hits = make(keeps_first_hits(features) ? paths * sizeof(shared::FirstHit) : 0),
            .queues = make(paths * 2 * sizeof(std::uint32_t)),
            .hits = make(paths * sizeof(shared::Hit)),
            .shadows = make(samples_lights(features) ? paths * sizeof(shared::WaveShadow) : 0),
            .counts = make((SliceWaves::most_steps + 1) * sizeof(shared::WaveCounts),
                           Usage::eIndirectBuffer | Usage::eTransferDst | Usage::eTransferSrc)};
}

}  // namespace

std::uint32_t path_capacity(const Gpu& gpu, std::uint64_t paths) {
    const std::uint64_t bytes = largest_heap_bytes(gpu, vk::MemoryHeapFlagBits::eDeviceLocal);
    const std::uint64_t room = bytes / part_of_memory / wave_path_bytes(all_buffers);
    const std::uint64_t most = std::clamp(room, fewest_wanted, std::min(most_paths, most_invocations(gpu)));
    return static_cast<std::uint32_t>(std::clamp(paths, fewest_wanted, most));
}

std::uint64_t wave_path_bytes(std::uint32_t features) {
    return sizeof(shared::WavePath) + (keeps_first_hits(features) ? sizeof(shared::FirstHit) : 0) +
           2 * sizeof(std::uint32_t) + sizeof(shared::Hit) + (samples_lights(features) ? sizeof(shared::WaveShadow) : 0);
}

WaveMemory make_wave_memory(const Gpu& gpu, std::uint32_t capacity, std::uint32_t features) {
    std::uint32_t fitting = capacity;
    while (fitting > fewest_paths) {
        try {
            return allocate_waves(gpu, capacity, fitting, features);
        } catch (const OutOfMemory&) {
            fitting = std::max(fitting / 2, fewest_paths);
        }
    }
    return allocate_waves(gpu, capacity, fitting, features);
}

bool fits(const WaveMemory& memory, std::uint32_t capacity, std::uint32_t features) {
    return memory.wanted >= capacity && (capacity > 0 || memory.wanted == 0) &&
           (memory.first_hits.size > 0) == keeps_first_hits(features) &&
           (memory.shadows.size > 0) == samples_lights(features);
}

std::uint64_t wave_memory_bytes(const WaveMemory& memory) {
    std::uint64_t bytes = 0;
    for (const Buffer* buffer : buffers_of(memory)) {
        bytes += buffer->size;
    }
    return bytes;
}

void enter_waves(SceneAddresses& addresses, const WaveMemory& memory) {
    addresses.wave_paths = memory.paths.address;
    addresses.wave_first_hits = memory.first_hits.address;
    addresses.wave_queues = memory.queues.address;
    addresses.wave_hits = memory.hits.address;
    addresses.wave_shadows = memory.shadows.address;
    addresses.wave_counts = memory.counts.address;
}

SliceWaves::SliceWaves(const WavePipelines& pipelines, const PipelineLayout& layout, const Bindings& bindings,
                       const WaveMemory& memory, const Slice& slice, const shared::Dispatch& request)
    : pipelines_(pipelines), layout_(layout), bindings_(bindings), memory_(memory), dispatch_(request) {
    tell(dispatch_, slice);
    dispatch_.path_capacity = memory.capacity;
}

void SliceWaves::begin(Recorder& recorder) {
    const std::uint64_t paths = pixels_of(dispatch_) * dispatch_.sample_count;
    if (pipelines_.rays != nullptr) {
        const std::uint64_t listed = pipelines_.begin_appends ? 0 : paths;
        count_from(recorder, {.rays = {static_cast<std::uint32_t>(listed), 1, 1},
                              .shading = {groups_for(listed), 1, 1},
                              .shadows = {0, 1, 1}});
    }
    bind_pass(recorder, *pipelines_.begin, layout_, bindings_, dispatch_);
    recorder->dispatch(groups_for(paths), 1, 1);
}

void SliceWaves::step(Recorder& recorder) {
    trace(recorder, *pipelines_.rays, offsetof(shared::WaveCounts, rays));
    if (pipelines_.shadows != nullptr) {
        trace(recorder, *pipelines_.shadows, offsetof(shared::WaveCounts, shadows));
    }
    bind_pass(recorder, *pipelines_.shade, layout_, bindings_, dispatch_, {counts_read});
    recorder->dispatchIndirect(*memory_.counts.handle, counts_at(offsetof(shared::WaveCounts, shading)));
    ++dispatch_.wave;
}

void SliceWaves::finish(Recorder& recorder) {
    if (pipelines_.film == nullptr) {
        return;
    }
    bind_pass(recorder, *pipelines_.film, layout_, bindings_, dispatch_);
    recorder->dispatch(groups_for(pixels_of(dispatch_)), 1, 1);
}

shared::WaveCounts SliceWaves::counts_left(const Gpu& gpu) const {
    return read_array<shared::WaveCounts>(gpu, memory_.counts)[dispatch_.wave];
}

void SliceWaves::resume(Recorder& recorder, const shared::WaveCounts& left) {
    static_assert(most_steps % 2 == 0);  // so that the queue to read stays the same
    assert(dispatch_.wave == most_steps);
    count_from(recorder, left);
}

// Sets the counts of all waves of a submission, starting with `first`, so that none has to be cleared in between.
void SliceWaves::count_from(Recorder& recorder, const shared::WaveCounts& first) {
    std::array<shared::WaveCounts, most_steps + 1> counts;
    counts.fill({.rays = {0, 1, 1}, .shading = {0, 1, 1}, .shadows = {0, 1, 1}});
    counts[0] = first;
    recorder.use({{Resource::wave_counts, Unit::transfer, Effect::write}});
    recorder->updateBuffer<shared::WaveCounts>(*memory_.counts.handle, 0, counts);
    dispatch_.wave = 0;
}

std::uint64_t SliceWaves::counts_at(std::size_t member) const {
    return dispatch_.wave * sizeof(shared::WaveCounts) + member;
}

void SliceWaves::trace(Recorder& recorder, const TracePipeline& pipeline, std::size_t counted) const {
    bind_pass(recorder, pipeline, layout_, bindings_, dispatch_, {counts_read});
    trace_indirect(recorder, pipeline, memory_.counts.address + counts_at(counted));
}

}  // namespace diptych::core
