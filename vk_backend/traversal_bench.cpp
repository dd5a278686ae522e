#include <algorithm>
#include <vector>

#include "path_renderer.h"
#include "readback.h"
#include "shader_binaries.h"
#include "upload.h"

namespace diptych {
namespace {

constexpr int repeats = 5;  // the median of which counts
constexpr std::uint64_t most_ray_bytes = std::uint64_t{1} << 29U;

using Usage = vk::BufferUsageFlagBits;

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

// Which paths are recorded: as many samples of the whole film as fit, or one sample of rows about its middle.
struct Block {
    Region region;
    std::uint32_t samples = 0;
    std::uint32_t capacity = 0;  // rays of each kind a path

    std::uint64_t paths_per_sample() const { return std::uint64_t{region.width} * region.height; }
    std::uint64_t paths() const { return paths_per_sample() * samples; }
    std::uint64_t rays() const { return paths() * capacity * 2; }
};

Block choose_block(const Gpu& gpu, shared::uvec2 size, std::uint32_t samples, std::uint32_t capacity) {
    std::uint64_t device_bytes = 0;
    for (std::uint32_t i = 0; i < gpu.memory.memoryHeapCount; ++i) {
        device_bytes = std::max(device_bytes, gpu.memory.memoryHeaps[i].size);
    }
    const std::uint64_t path_bytes = std::uint64_t{capacity} * 2 * sizeof(shared::RecordedRay);
    const std::uint64_t paths = std::min(most_ray_bytes, device_bytes / 4) / path_bytes;
    const std::uint64_t pixels = std::uint64_t{size.x} * size.y;
    Block block{.region = {0, 0, size.x, size.y}, .samples = 1, .capacity = capacity};
    if (paths >= pixels) {
        block.samples = static_cast<std::uint32_t>(std::min<std::uint64_t>(paths / pixels, std::max(samples, 1U)));
    } else {
        block.region.height = static_cast<std::uint32_t>(std::max<std::uint64_t>(paths / size.x, 1));
        block.region.y = (size.y - block.region.height) / 2;
    }
    return block;
}

// The bench's own buffers.
struct RayMemory {
    Buffer rays;
    Buffer counters;
};

RayMemory make_ray_memory(const Gpu& gpu, const Block& block) {
    const vk::BufferUsageFlags usage =
        Usage::eStorageBuffer | Usage::eShaderDeviceAddress | Usage::eTransferDst | Usage::eTransferSrc;
    RayMemory memory;
    memory.rays =
        make_buffer(gpu, "recorded rays", block.rays() * sizeof(shared::RecordedRay), usage, MemoryKind::device);
    memory.counters = make_buffer(gpu, "ray counters", sizeof(shared::RayCounters), usage, MemoryKind::device);
    run_commands(gpu, [&](const vk::raii::CommandBuffer& commands) {
        commands.fillBuffer(*memory.rays.handle, 0, VK_WHOLE_SIZE, 0);
        commands.fillBuffer(*memory.counters.handle, 0, VK_WHOLE_SIZE, 0);
        full_barrier(commands);
    });
    return memory;
}

// Leaves the rays that were recorded and no gaps: closest hits before any hits, earlier bounces before later ones. So
// neighbours do the same, and nothing but their traversal is timed. Returns how many there are.
std::uint64_t close_gaps(const Gpu& gpu, const RayMemory& memory) {
    std::vector<shared::RecordedRay> rays = read_array<shared::RecordedRay>(gpu, memory.rays);
    std::erase_if(rays, [](const shared::RecordedRay& ray) { return ray.t_max == 0.0F; });
    Uploader uploader(gpu);
    uploader.upload(memory.rays, std::as_bytes(std::span(rays)));
    uploader.finish();
    return rays.size();
}

// Runs pipelines over a block, in slices, and times them. What it learns of a pipeline's speed lasts from run to run, so that only
// the first is cut into small pieces.
struct Runner {
    const Gpu& gpu;
    const PipelineLayout& layout;
    const Block& block;

    double integrate(const TracePipeline& pipeline, const Bindings& bindings, bool one_by_one, SpeedEstimate& speed) const {
        TimedQueue queue(gpu, [&](std::uint64_t work, double seconds) { speed.learn(work, seconds); });
        SliceCursor cursor(block.region, 0, block.samples);
        const std::uint64_t limit = gpu.ray_tracing.maxRayDispatchInvocationCount;
        while (!cursor.done()) {
            const std::uint64_t budget =
                one_by_one ? std::min(speed.budget(), block.paths_per_sample()) : speed.budget();
            const Slice slice = cursor.next(budget, limit);
            const std::uint64_t lane = slice.first_sample * block.paths_per_sample() +
                                       std::uint64_t{slice.region.y - block.region.y} * block.region.width +
                                       (slice.region.x - block.region.x);
            shared::Dispatch dispatch{};
            dispatch.origin = {slice.region.x, slice.region.y};
            dispatch.first_sample = slice.first_sample;
            dispatch.sample_count = slice.sample_count;
            dispatch.first_lane = static_cast<std::uint32_t>(lane);
            dispatch.lane_count = static_cast<std::uint32_t>(block.paths());
            dispatch.ray_capacity = block.capacity;
            queue.submit(slice.work(), [&](const vk::raii::CommandBuffer& commands) {
                record_dispatch(commands, pipeline, layout, bindings, dispatch, slice.region.width,
                                slice.region.height);
            });
        }
        queue.drain();
        return queue.seconds();
    }

    double trace_again(const TracePipeline& pipeline, const Bindings& bindings, std::uint64_t rays,
                       SpeedEstimate& speed) const {
        TimedQueue queue(gpu, [&](std::uint64_t work, double seconds) { speed.learn(work, seconds); });
        const std::uint64_t limit = gpu.ray_tracing.maxRayDispatchInvocationCount;
        std::uint64_t ray = 0;
        while (ray < rays) {
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
    return in_context("measuring traversal", [&] {
        const TracePipeline recording = compile(shader_binary("path.rgen"), true);
        const TracePipeline bare = compile(shader_binary("bare.rgen"), false);
        const FilmMemory film = make_film(*gpu_, film_.width, film_.height, features_);
        std::uint32_t capacity = std::min(constants_.max_depth, 31U) + 2;
        while (true) {
            const Block block = choose_block(*gpu_, constants_.size, samples, capacity);
            const RayMemory memory = make_ray_memory(*gpu_, block);
            SceneAddresses all = addresses(film);
            all.recorded_rays = memory.rays.address;
            all.ray_counters = memory.counters.address;
            const Bindings bindings = make_bindings(*gpu_, layout_, *top_.structure, all, constants_);
            warm_up(recording, bindings);
            warm_up(bare, bindings);
            const Runner runner{.gpu = *gpu_, .layout = layout_, .block = block};
            SpeedEstimate recording_speed;
            runner.integrate(recording, bindings, true, recording_speed);
            const shared::RayCounters counters = read_array<shared::RayCounters>(*gpu_, memory.counters).front();
            if (counters.dropped > 0) {
                capacity *= 2;
                continue;
            }
            const std::uint64_t rays = close_gaps(*gpu_, memory);
            SpeedEstimate integrator_speed;
            SpeedEstimate traversal_speed;
            runner.integrate(path_, bindings, false, integrator_speed);
            runner.trace_again(bare, bindings, rays, traversal_speed);
            std::vector<double> integrator;
            std::vector<double> traversal;
            for (int i = 0; i < repeats; ++i) {
                integrator.push_back(runner.integrate(path_, bindings, false, integrator_speed));
                traversal.push_back(runner.trace_again(bare, bindings, rays, traversal_speed));
            }
            return TraversalBench{
                .rays = rays, .integrator_seconds = median(integrator), .bare_seconds = median(traversal)};
        }
    });
}

}  // namespace diptych
