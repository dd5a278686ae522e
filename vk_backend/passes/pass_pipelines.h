// The pipelines of passes. Those that a renderer needs are compiled side by side, as some drivers take seconds for one.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "pipelines/pipeline.h"

namespace diptych::core {

/// The shaders of a pipeline with this ray generation shader; with any-hit shaders only if `alpha`.
PipelineShaders scene_shaders(Spirv ray_generation, bool alpha);

/// Compiles a pipeline alone, which is not stored.
TracePipeline compile_trace_pipeline(const Gpu& gpu, const PipelineLayout& layout, Spirv ray_generation,
                                     const PipelineConstants& constants);

class PassPipelines {
public:
    PassPipelines(const Gpu& gpu, const PipelineLayout& layout, const PipelineConstants& constants);

    /// Asks for a pipeline, of which complete() tells `place`.
    void want(const TracePipeline*& place, Spirv ray_generation);
    void want(const ComputePipeline*& place, Spirv shader);

    /// Takes the pipelines from the device's store, for which it compiles those that are missing. `before`, unless
    /// empty, is called with their number before they are compiled. Returns the number of compiled ones.
    std::size_t complete(const std::function<void(std::size_t missing)>& before = {});

private:
    using Compiled = vk::raii::Pipeline;
    struct Wanted {
        std::function<bool()> take;                                      // whether the store has it
        std::function<Compiled(const vk::raii::PipelineCache&)> compile;  // in any thread
        std::function<void(Compiled)> keep;
    };

    std::vector<Compiled> compile(const std::vector<const Wanted*>& missing) const;

    const Gpu& gpu_;
    const PipelineLayout& layout_;
    PipelineConstants constants_;
    std::vector<Wanted> wanted_;
};

}  // namespace diptych::core
