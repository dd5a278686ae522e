// Traces paths on the device for their records, not for the film.
#include <algorithm>

#include "error.h"
#include "passes/pass_pipelines.h"
#include "renderer/path_renderer.h"
#include "memory/readback.h"
#include "shader_binaries.h"
#include "memory/upload.h"

namespace diptych::core {
namespace {

using Queries = std::span<const shared::PathQuery>;
using Usage = vk::BufferUsageFlagBits;

constexpr std::uint64_t most_bytes = std::uint64_t{256} << 20U;  // of records on the device at a time

Buffer record_buffer(const Gpu& gpu, std::uint64_t bytes) {
    return make_buffer(gpu, Purpose::recorded_paths, bytes,
                       Usage::eStorageBuffer | Usage::eShaderDeviceAddress | Usage::eTransferSrc, MemoryKind::device);
}

}  // namespace

void PathRenderer::trace_listed(Queries queries, const shared::RenderConstants& constants,
                                std::uint32_t vertices_per_path, const Buffer& vertices, const Buffer& summaries) {
    require_bound();
    const TracePipeline* recording = nullptr;
    PassPipelines pipelines(*gpu_, layout_, pipeline_constants(false));
    pipelines.want(recording, shader_binary("record.rgen"));
    pipelines_compiled_ += pipelines.complete();
    if (!recording_speed_) {
        recording_speed_.emplace(dispatch_seconds_);
    }
    Uploader uploader(*gpu_);
    const Buffer list =
        upload_array(*gpu_, uploader, Purpose::recorded_paths, queries,
                     Usage::eStorageBuffer | Usage::eShaderDeviceAddress);
    uploader.finish();
    SceneAddresses all = addresses(*film_);
    all.path_queries = list.address;
    all.path_vertices = vertices.address;
    all.path_summaries = summaries.address;
    const Bindings bindings = make_bindings(*gpu_, layout_, {.scene = *top_.structure}, all, constants);
    TimedQueue queue(*gpu_, [&](std::uint64_t work, double seconds) { recording_speed_->learn(work, seconds); });
    for (std::uint64_t first = 0; first < queries.size();) {
        const std::uint64_t limit = gpu_->ray_tracing.maxRayDispatchInvocationCount;
        const std::uint64_t count = std::min({queries.size() - first, recording_speed_->budget(), limit});
        shared::Dispatch dispatch{};
        dispatch.first_path = static_cast<std::uint32_t>(first);
        dispatch.vertices_per_path = vertices_per_path;
        queue.submit(count, [&](Recorder& recorder) {
            record_dispatch(recorder, *recording, layout_, bindings, dispatch, static_cast<std::uint32_t>(count), 1);
        });
        first += count;
    }
    queue.drain();
}

std::vector<shared::PathSummary> PathRenderer::summarize_paths(Queries queries) {
    return in_context("tracing paths", [&] { return summarize(queries, constants_); });
}

std::vector<shared::PathSummary> PathRenderer::summarize(Queries queries, const shared::RenderConstants& constants) {
    constexpr std::size_t at_a_time = most_bytes / sizeof(shared::PathSummary);
    std::vector<shared::PathSummary> found;
    found.reserve(queries.size());
    for (std::size_t first = 0; first < queries.size(); first += at_a_time) {
        const Queries part = queries.subspan(first, std::min(at_a_time, queries.size() - first));
        const Buffer summaries = record_buffer(*gpu_, part.size() * sizeof(shared::PathSummary));
        trace_listed(part, constants, 0, Buffer{}, summaries);
        const auto read = read_array<shared::PathSummary>(*gpu_, summaries);
        found.insert(found.end(), read.begin(), read.end());
    }
    return found;
}

std::vector<RecordedPath> PathRenderer::record_paths(Queries queries, std::optional<std::uint32_t> seed) {
    shared::RenderConstants constants = constants_;
    constants.seed = seed.value_or(constants.seed);
    return in_context("recording paths", [&] {
        // A path has one vertex more than scattering events. Few paths come near the limit, so their lengths are
        // computed first.
        const std::vector<shared::PathSummary> lengths = summarize(queries, constants);
        std::vector<RecordedPath> paths(queries.size());
        for (std::size_t first = 0; first < queries.size();) {
            std::uint32_t longest = 1;
            std::size_t end = first;
            while (end < queries.size()) {
                const std::uint32_t with_next = std::max(longest, lengths[end].vertices);
                if (end > first && (end - first + 1) * with_next * sizeof(shared::PathVertexRecord) > most_bytes) {
                    break;
                }
                longest = with_next;
                ++end;
            }
            const std::size_t count = end - first;
            const Buffer vertices = record_buffer(*gpu_, count * longest * sizeof(shared::PathVertexRecord));
            const Buffer summaries = record_buffer(*gpu_, count * sizeof(shared::PathSummary));
            trace_listed(queries.subspan(first, count), constants, longest, vertices, summaries);
            const auto found = read_array<shared::PathSummary>(*gpu_, summaries);
            const auto records = read_array<shared::PathVertexRecord>(*gpu_, vertices);
            for (std::size_t i = 0; i < count; ++i) {
                const auto begin = records.begin() + static_cast<std::ptrdiff_t>(i * longest);
                paths[first + i].vertices.assign(begin, begin + std::min(found[i].vertices, longest));
                paths[first + i].radiance = found[i].radiance;
            }
            first = end;
        }
        return paths;
    });
}

}  // namespace diptych::core
