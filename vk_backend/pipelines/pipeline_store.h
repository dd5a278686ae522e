// The pipelines that a device has compiled, for all renderers on it: some drivers take seconds for one.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <tuple>

#include "pipelines/pipeline.h"

namespace diptych::core {

/// Shader (of a trace pipeline, the ray generation shader), features, and whether instances may be grouped.
using PipelineKey = std::tuple<const std::uint32_t*, std::uint32_t, bool>;

/// Pipelines stay until the device goes, so references to them hold as long as the device does.
struct PipelineStore {
    std::map<PipelineKey, TracePipeline> trace;
    std::map<PipelineKey, ComputePipeline> compute;
};

/// The pipeline of that key; the first time, what `compile` makes. Any thread may ask, and none waits for another's
/// compiler.
template <typename Pipeline, typename Compile>
const Pipeline& stored_pipeline(const Gpu& gpu, std::map<PipelineKey, Pipeline> PipelineStore::*kind,
                                const PipelineKey& key, const Compile& compile) {
    {
        const std::lock_guard lock(gpu.pipelines_mutex);
        if (gpu.pipelines == nullptr) {
            gpu.pipelines = std::make_shared<PipelineStore>();
        }
        const auto& pipelines = (*gpu.pipelines).*kind;
        if (const auto found = pipelines.find(key); found != pipelines.end()) {
            return found->second;
        }
    }
    Pipeline made = compile();
    const std::lock_guard lock(gpu.pipelines_mutex);
    return ((*gpu.pipelines).*kind).try_emplace(key, std::move(made)).first->second;
}

}  // namespace diptych::core
