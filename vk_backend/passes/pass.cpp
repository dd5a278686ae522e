#include "passes/pass.h"

namespace diptych::core {
namespace {

void bind(const vk::raii::CommandBuffer& commands, vk::PipelineBindPoint point, const vk::raii::Pipeline& pipeline,
          const PipelineLayout& layout, const Bindings& bindings, const shared::Dispatch& dispatch) {
    commands.bindPipeline(point, *pipeline);
    commands.bindDescriptorSets(point, *layout.layout, 0, bindings.set, {});
    commands.pushConstants<shared::Dispatch>(*layout.layout, pushed_stages, 0, dispatch);
}

}  // namespace

std::uint64_t most_invocations(const Gpu& gpu) {
    return std::uint64_t{gpu.most_workgroups} * shared::WAVE_GROUP;
}

std::uint32_t groups_for(std::uint64_t invocations) {
    return static_cast<std::uint32_t>((invocations + shared::WAVE_GROUP - 1) / shared::WAVE_GROUP);
}

void tell(shared::Dispatch& dispatch, const Slice& slice) {
    dispatch.origin = {slice.region.x, slice.region.y};
    dispatch.region = {slice.region.width, slice.region.height};
    dispatch.first_sample = slice.first_sample;
    dispatch.sample_count = slice.sample_count;
}

void bind_pass(Recorder& recorder, const TracePipeline& pipeline, const PipelineLayout& layout,
               const Bindings& bindings, const shared::Dispatch& dispatch, std::initializer_list<Use> more) {
    recorder.use(pipeline.uses, more);
    bind(recorder, vk::PipelineBindPoint::eRayTracingKHR, pipeline.pipeline, layout, bindings, dispatch);
}

void bind_pass(Recorder& recorder, const ComputePipeline& compute, const PipelineLayout& layout,
               const Bindings& bindings, const shared::Dispatch& dispatch, std::initializer_list<Use> more) {
    recorder.use(compute.uses, more);
    bind(recorder, vk::PipelineBindPoint::eCompute, compute.pipeline, layout, bindings, dispatch);
}

void compute_region(Recorder& recorder, const ComputePipeline& compute, const PipelineLayout& layout,
                    const Bindings& bindings, const shared::Dispatch& dispatch) {
    const auto groups = [](std::uint32_t pixels) { return (pixels + shared::REGION_SIDE - 1) / shared::REGION_SIDE; };
    bind_pass(recorder, compute, layout, bindings, dispatch);
    recorder->dispatch(groups(dispatch.region.x), groups(dispatch.region.y), 1);
}

}  // namespace diptych::core
