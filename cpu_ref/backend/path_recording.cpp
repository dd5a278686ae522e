#include "backend/path_recording.h"

#include <tbb/blocked_range.h>

#include "backend/cpu_kernel.h"
#include "parallel.h"

namespace diptych::core {
namespace {

using Queries = std::span<const shared::PathQuery>;

/// Calls `keep(index, vertices, radiance)` for every path.
template <class Keep>
void trace_paths(const PackedScene& packed, const shared::RenderConstants& constants, const EmbreeScene& scene,
                 Queries queries, const Keep& keep) {
    parallel_over(tbb::blocked_range<std::size_t>(0, queries.size(), 64), [&](const auto& range) {
        std::vector<shared::PathVertexRecord> vertices;
        shared::CpuKernel<PathRecorder, ~0U> kernel{packed, constants, {scene, vertices}};
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            vertices.clear();
            const auto sample = kernel.trace_path(queries[i].pixel, queries[i].sample_index);
            keep(i, vertices, sample.radiance);
        }
    });
}

}  // namespace

std::vector<RecordedPath> record_paths(const PackedScene& packed, const shared::RenderConstants& constants,
                                       const EmbreeScene& scene, Queries queries) {
    std::vector<RecordedPath> paths(queries.size());
    trace_paths(packed, constants, scene, queries, [&](std::size_t i, const auto& vertices, const glm::vec3& radiance) {
        paths[i] = {vertices, radiance};
    });
    return paths;
}

std::vector<shared::PathSummary> summarize_paths(const PackedScene& packed, const shared::RenderConstants& constants,
                                                 const EmbreeScene& scene, Queries queries) {
    std::vector<shared::PathSummary> summaries(queries.size());
    trace_paths(packed, constants, scene, queries, [&](std::size_t i, const auto& vertices, const glm::vec3& radiance) {
        shared::PathSummary summary = shared::begin_path_summary();
        for (const shared::PathVertexRecord& vertex : vertices) {
            shared::summarize_vertex(summary, vertex);
        }
        summary.radiance = radiance;
        summaries[i] = summary;
    });
    return summaries;
}

}  // namespace diptych::core
