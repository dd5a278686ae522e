#include <algorithm>
#include <vector>

#include "error.h"
#include "passes/pass_pipelines.h"
#include "renderer/path_renderer.h"
#include "device/heap_room.h"
#include "memory/readback.h"
#include "shader_binaries.h"

namespace diptych::core {
namespace {

constexpr int repeats = 7;  // the result is their median
constexpr std::uint64_t most_ray_bytes = std::uint64_t{4} << 30U;

using Usage = vk::BufferUsageFlagBits;

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

// The paths that are measured: the whole film, or as many rows about its middle as have room for their rays.
struct Block {
    Region region;
    std::uint32_t samples = 0;
};

// Buffers of the bench.
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
    memory.rays = make_buffer(gpu, Purpose::recorded_paths, std::max(capacity, 1U) * sizeof(shared::RecordedRay), usage,
                              MemoryKind::device);
    memory.counters = make_buffer(gpu, Purpose::recorded_paths, sizeof(shared::RayCounters), usage, MemoryKind::device);
    run_commands(gpu, [&](Recorder& recorder) {
        recorder.use({{Resource::recorded_rays, Unit::transfer, Effect::write}});
        recorder->fillBuffer(*memory.counters.handle, 0, VK_WHOLE_SIZE, 0);
    });
    return memory;
}

std::uint64_t count_rays(const Gpu& gpu, const RayMemory& memory) {
    const shared::RayCounters counters = read_array<shared::RayCounters>(gpu, memory.counters).front();
    return std::uint64_t{counters.closest} + counters.any;
}

// Traces recorded rays again, in several dispatches.
struct Tracer {
    const Gpu& gpu;
    const PipelineLayout& layout;
    const TracePipeline& pipeline;
    const Bindings& bindings;
    SpeedEstimate speed{};  // kept between runs, so that only the first run has small dispatches

    /// Returns device time, seconds.
    double trace(std::uint64_t rays) {
        TimedQueue queue(gpu, [&](std::uint64_t work, double seconds) { speed.learn(work, seconds); });
        for (std::uint64_t ray = 0; ray < rays;) {
            const std::uint64_t limit = gpu.ray_tracing.maxRayDispatchInvocationCount;
            const std::uint64_t count = std::min({rays - ray, speed.budget(), limit});
            shared::Dispatch dispatch{};
            dispatch.first_ray = static_cast<std::uint32_t>(ray);
            queue.submit(count, [&](Recorder& recorder) {
                record_dispatch(recorder, pipeline, layout, bindings, dispatch, static_cast<std::uint32_t>(count), 1);
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
        const auto compile = [&](const char* ray_generation, bool record_rays) {
            return compile_trace_pipeline(*gpu_, layout_, shader_binary(ray_generation),
                                          pipeline_constants(record_rays));
        };
        const TracePipeline recording_rays = compile("wave_rays.rgen", true);
        const TracePipeline recording_shadows = compile("wave_shadows.rgen", true);
        WavePipelines recording = wave_pipelines_;
        recording.rays = &recording_rays;
        recording.shadows = recording.shadows != nullptr ? &recording_shadows : nullptr;
        const TracePipeline bare = compile("bare.rgen", false);
        const FilmMemory film = make_film(*gpu_, film_->width, film_->height, features_);
        const auto bind = [&](const RayMemory& memory) {
            SceneAddresses all = addresses(film);
            all.recorded_rays = memory.rays.address;
            all.ray_counters = memory.counters.address;
            return make_bindings(*gpu_, layout_, {.scene = *top_.structure}, all, constants_);
        };
        SpeedEstimate speed(dispatch_seconds_);  // of this integrator, shared by all runs
        const auto integrate = [&](const WavePipelines& pipelines, const Bindings& bindings, const Block& block,
                                   std::uint32_t ray_capacity) {
            TimedQueue queue(*gpu_, [&](std::uint64_t work, double seconds) { speed.learn(work, seconds); });
            SliceCursor cursor(block.region, 0, block.samples);
            shared::Dispatch request{};
            request.ray_capacity = ray_capacity;
            while (!cursor.done()) {
                submit_slice(queue, pipelines, bindings, next_slice(cursor, speed), request);
            }
            queue.drain();
            return queue.seconds();
        };
        // Without room for rays, a recording only counts them.
        const auto rays_of = [&](const Block& block) {
            const RayMemory memory = make_ray_memory(*gpu_, 0);
            const Bindings bindings = bind(memory);
            integrate(recording, bindings, block, 0);
            return count_rays(*gpu_, memory);
        };
        const std::uint64_t room =
            std::min(most_ray_bytes, largest_heap_bytes(*gpu_) / 4) / sizeof(shared::RecordedRay);
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
        integrate(recording, bindings, block, memory.capacity);
        Tracer traversal{*gpu_, layout_, bare, bindings};
        integrate(wave_pipelines_, bindings, block, 0);
        traversal.trace(rays);
        std::vector<double> integrator_seconds;
        std::vector<double> bare_seconds;
        for (int i = 0; i < repeats; ++i) {
            integrator_seconds.push_back(integrate(wave_pipelines_, bindings, block, 0));
            bare_seconds.push_back(traversal.trace(rays));
        }
        return TraversalBench{
            .rays = rays, .integrator_seconds = median(integrator_seconds), .bare_seconds = median(bare_seconds)};
    });
}

}  // namespace diptych::core
