#include "passes/pass_pipelines.h"

#include <exception>
#include <filesystem>
#include <utility>

#include "device/pipeline_cache.h"
#include "language/scene_features.h"
#include "passes/pass_table.h"
#include "pipelines/pipeline_store.h"
#include "shader_binaries.h"
#include "threads.h"

namespace diptych::core {
namespace {

PipelineShaders shaders_for(Spirv ray_generation, const PipelineConstants& constants) {
    return scene_shaders(ray_generation, (constants.features & shared::FEATURE_ALPHA) != 0);
}

TracePipeline finished(const Gpu& gpu, vk::raii::Pipeline compiled, Spirv ray_generation) {
    TracePipeline made = with_table(gpu, std::move(compiled));
    made.uses = uses_of(ray_generation);
    return made;
}

}  // namespace

PipelineShaders scene_shaders(Spirv ray_generation, bool alpha) {
    PipelineShaders shaders{.ray_generation = ray_generation,
                            .closest_hit = shader_binary("closest.rchit"),
                            .closest_miss = shader_binary("closest.rmiss"),
                            .shadow_miss = shader_binary("shadow.rmiss"),
                            .closest_any_hit = {},
                            .shadow_any_hit = {}};
    if (alpha) {
        shaders.closest_any_hit = shader_binary("closest.rahit");
        shaders.shadow_any_hit = shader_binary("shadow.rahit");
    }
    return shaders;
}

TracePipeline compile_trace_pipeline(const Gpu& gpu, const PipelineLayout& layout, Spirv ray_generation,
                                     const PipelineConstants& constants) {
    const std::filesystem::path path = pipeline_cache_path(gpu);
    const vk::raii::PipelineCache cache = open_pipeline_cache(gpu, path);
    vk::raii::Pipeline compiled =
        compile_trace_shaders(gpu, layout, cache, shaders_for(ray_generation, constants), constants);
    save_pipeline_cache(cache, path);
    return finished(gpu, std::move(compiled), ray_generation);
}

PassPipelines::PassPipelines(const Gpu& gpu, const PipelineLayout& layout, const PipelineConstants& constants)
    : gpu_(gpu), layout_(layout), constants_(constants) {}

void PassPipelines::want(const TracePipeline*& place, Spirv ray_generation) {
    const PipelineKey key{ray_generation.data(), constants_.features, constants_.groups != 0};
    wanted_.push_back({.take =
                           [this, &place, key] {
                               place = find_pipeline(gpu_, &PipelineStore::trace, key);
                               return place != nullptr;
                           },
                       .compile =
                           [this, ray_generation](const vk::raii::PipelineCache& cache) {
                               return compile_trace_shaders(gpu_, layout_, cache,
                                                            shaders_for(ray_generation, constants_), constants_);
                           },
                       .keep =
                           [this, &place, key, ray_generation](Compiled compiled) {
                               place = &store_pipeline(gpu_, &PipelineStore::trace, key,
                                                       finished(gpu_, std::move(compiled), ray_generation));
                           }});
}

void PassPipelines::want(const ComputePipeline*& place, Spirv shader) {
    const PipelineKey key{shader.data(), constants_.features, false};  // only hit shaders use groups
    wanted_.push_back({.take =
                           [this, &place, key] {
                               place = find_pipeline(gpu_, &PipelineStore::compute, key);
                               return place != nullptr;
                           },
                       .compile =
                           [this, shader](const vk::raii::PipelineCache& cache) {
                               return make_compute_pipeline(gpu_, layout_, cache, shader, constants_);
                           },
                       .keep =
                           [this, &place, key, shader](Compiled compiled) {
                               place = &store_pipeline(
                                   gpu_, &PipelineStore::compute, key,
                                   ComputePipeline{.pipeline = std::move(compiled), .uses = uses_of(shader)});
                           }});
}

std::size_t PassPipelines::complete(const std::function<void(std::size_t)>& before) {
    std::vector<const Wanted*> missing;
    for (const Wanted& wanted : wanted_) {
        if (!wanted.take()) {
            missing.push_back(&wanted);
        }
    }
    if (missing.empty()) {
        return 0;
    }
    if (before) {
        before(missing.size());
    }
    std::vector<Compiled> compiled = compile(missing);
    for (std::size_t i = 0; i < missing.size(); ++i) {
        missing[i]->keep(std::move(compiled[i]));
    }
    return missing.size();
}

// One thread a core. The driver's cache on disk is read once before all and written once after all.
std::vector<vk::raii::Pipeline> PassPipelines::compile(const std::vector<const Wanted*>& missing) const {
    const std::filesystem::path path = pipeline_cache_path(gpu_);
    const vk::raii::PipelineCache cache = open_pipeline_cache(gpu_, path);
    std::vector<Compiled> compiled;
    for (std::size_t i = 0; i < missing.size(); ++i) {
        compiled.emplace_back(nullptr);
    }
    std::vector<std::exception_ptr> failures(missing.size());
    in_parts(missing.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            try {
                compiled[i] = missing[i]->compile(cache);
            } catch (...) {
                failures[i] = std::current_exception();
            }
        }
    });
    for (const std::exception_ptr& failure : failures) {
        if (failure) {
            std::rethrow_exception(failure);
        }
    }
    save_pipeline_cache(cache, path);
    return compiled;
}

}  // namespace diptych::core
