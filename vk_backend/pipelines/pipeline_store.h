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

/// The pipeline of that key, or null. May be called from any thread.
template <typename Pipeline>
const Pipeline* find_pipeline(const Gpu& gpu, std::map<PipelineKey, Pipeline> PipelineStore::*kind,
                              const PipelineKey& key) {
    const std::lock_guard lock(gpu.pipelines_mutex);
    if (gpu.pipelines == nullptr) {
        return nullptr;
    }
    const auto& pipelines = (*gpu.pipelines).*kind;
    const auto found = pipelines.find(key);
    return found != pipelines.end() ? &found->second : nullptr;
}

/// Stores a pipeline, unless another thread has stored one of that key since. Returns the stored one.
template <typename Pipeline>
const Pipeline& store_pipeline(const Gpu& gpu, std::map<PipelineKey, Pipeline> PipelineStore::*kind,
                               const PipelineKey& key, Pipeline made) {
    const std::lock_guard lock(gpu.pipelines_mutex);
    if (gpu.pipelines == nullptr) {
        gpu.pipelines = std::make_shared<PipelineStore>();
    }
    return ((*gpu.pipelines).*kind).try_emplace(key, std::move(made)).first->second;
}

}  // namespace diptych::core
