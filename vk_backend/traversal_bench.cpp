#include <algorithm>
#include <vector>

#include "error.h"
#include "path_renderer.h"
#include "readback.h"
#include "shader_binaries.h"

namespace diptych {
namespace {

constexpr int repeats = 7;  // the median of which counts
constexpr std::uint64_t most_ray_bytes = std::uint64_t{4} << 30U;

using Usage = vk::BufferUsageFlagBits;

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

// Which paths are measured: the whole film, or as many rows about its middle as there is room for their rays.
struct Block {
    Region region;
    std::uint32_t samples = 0;
};

std::uint64_t device_bytes(const Gpu& gpu) {
    std::uint64_t bytes = 0;
    for (std::uint32_t i = 0; i < gpu.memory.memoryHeapCount; ++i) {
        bytes = std::max(bytes, gpu.memory.memoryHeaps[i].size);
    }
    return bytes;
}

// The bench's own buffers.
struct RayMemory {
    std::uint32_t capacity = 0;
    Buffer rays;
    Buffer counters;
};

RayMemory make_ray_memory(const Gpu& gpu, std::uint32_t capacity) {
    const vk::BufferUsageFlags usage =
        Usage::eStorageBuffer | Usage::eShaderDeviceAddress | Usage::eTransferDst | Usage::eTransferSrc;
    RayMemory memory;
    memory.capacity = capacity;
    memory.rays = make_buffer(gpu, "recorded rays", std::max(capacity, 1U) * sizeof(shared::RecordedRay), usage,
                              MemoryKind::device);
    memory.counters = make_buffer(gpu, "ray counters", sizeof(shared::RayCounters), usage, MemoryKind::device);
    run_commands(gpu, [&](const vk::raii::CommandBuffer& commands) {
        commands.fillBuffer(*memory.counters.handle, 0, VK_WHOLE_SIZE, 0);
        full_barrier(commands);
    });
    return memory;
}

std::uint64_t count_rays(const Gpu& gpu, const RayMemory& memory) {
    const shared::RayCounters counters = read_array<shared::RayCounters>(gpu, memory.counters).front();
    return std::uint64_t{counters.closest} + counters.any;
}

// One pipeline over one block or list of rays, cut into dispatches, in the device's seconds. What is learned of the
// pipeline's speed lasts from run to run, so that only the first is cut small.
struct Runner {
    const Gpu& gpu;
    const PipelineLayout& layout;
    const TracePipeline& pipeline;
    const Bindings& bindings;
    SpeedEstimate speed{};

    double integrate(const Block& block, std::uint32_t ray_capacity) {
        TimedQueue queue(gpu, [&](std::uint64_t work, double seconds) { speed.learn(work, seconds); });
        SliceCursor cursor(block.region, 0, block.samples);
        while (!cursor.done()) {
            const Slice slice = cursor.next(speed.budget(), gpu.ray_tracing.maxRayDispatchInvocationCount);
            shared::Dispatch dispatch{};
            dispatch.origin = {slice.region.x, slice.region.y};
            dispatch.first_sample = slice.first_sample;
            dispatch.sample_count = slice.sample_count;
            dispatch.ray_capacity = ray_capacity;
            queue.submit(slice.work(), [&](const vk::raii::CommandBuffer& commands) {
                record_dispatch(commands, pipeline, layout, bindings, dispatch, slice.region.width,
                                slice.region.height);
            });
        }
        queue.drain();
        return queue.seconds();
    }

    double trace(std::uint64_t rays) {
        TimedQueue queue(gpu, [&](std::uint64_t work, double seconds) { speed.learn(work, seconds); });
        for (std::uint64_t ray = 0; ray < rays;) {
            const std::uint64_t limit = gpu.ray_tracing.maxRayDispatchInvocationCount;
            const std::uint64_t count = std::min({rays - ray, speed.budget(), limit});
            shared::Dispatch dispatch{};
            dispatch.first_ray = static_cast<std::uint32_t>(ray);
            queue.submit(count, [&](const vk::raii::CommandBuffer& commands) {
                record_dispatch(commands, pipeline, layout, bindings, dispatch, static_cast<std::uint32_t>(count), 1);
            });
            ray += count;
        }
        queue.drain();
        return queue.seconds();
    }
};

}  // namespace

TraversalBench PathRenderer::bench_traversal(std::uint32_t samples) {
    require_bound();
    return in_context("measuring traversal", [&] {
        const TracePipeline recording = compile(shader_binary("path.rgen"), true);
        const TracePipeline bare = compile(shader_binary("bare.rgen"), false);
        const FilmMemory film = make_film(*gpu_, film_->width, film_->height, features_);
        const auto bind = [&](const RayMemory& memory) {
            SceneAddresses all = addresses(film);
            all.recorded_rays = memory.rays.address;
            all.ray_counters = memory.counters.address;
            return make_bindings(*gpu_, layout_, *top_.structure, *top_.structure, all, constants_);
        };
        // Recorded without room, a block tells how many rays it has.
        const auto rays_of = [&](const Block& block) {
            const RayMemory memory = make_ray_memory(*gpu_, 0);
            const Bindings bindings = bind(memory);
            Runner{*gpu_, layout_, recording, bindings}.integrate(block, 0);
            return count_rays(*gpu_, memory);
        };
        const std::uint64_t room = std::min(most_ray_bytes, device_bytes(*gpu_) / 4) / sizeof(shared::RecordedRay);
        Block block{{0, 0, constants_.size.x, constants_.size.y}, std::max(samples, 1U)};
        std::uint64_t rays = rays_of(block);
        while (rays > room && block.region.height > 1) {
            const std::uint64_t height = std::max<std::uint64_t>(block.region.height * room / rays * 9 / 10, 1);
            block.region.y = (constants_.size.y - static_cast<std::uint32_t>(height)) / 2;
            block.region.height = static_cast<std::uint32_t>(height);
            rays = rays_of(block);
        }
        if (rays == 0 || rays > room) {
            throw Error("the rays of one row need more memory than there is, or there are none");
        }
        const RayMemory memory = make_ray_memory(*gpu_, static_cast<std::uint32_t>(rays));
        const Bindings bindings = bind(memory);
        warm_up(bare, bindings);
        Runner{*gpu_, layout_, recording, bindings}.integrate(block, memory.capacity);
        Runner integrator{*gpu_, layout_, *path_, bindings};
        Runner traversal{*gpu_, layout_, bare, bindings};
        integrator.integrate(block, 0);
        traversal.trace(rays);
        std::vector<double> integrator_seconds;
        std::vector<double> bare_seconds;
        for (int i = 0; i < repeats; ++i) {
            integrator_seconds.push_back(integrator.integrate(block, 0));
            bare_seconds.push_back(traversal.trace(rays));
        }
        return TraversalBench{
            .rays = rays, .integrator_seconds = median(integrator_seconds), .bare_seconds = median(bare_seconds)};
    });
}

}  // namespace diptych
