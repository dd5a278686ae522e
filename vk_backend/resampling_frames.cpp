#include <vector>

#include "path_renderer.h"

namespace diptych {

// Passes of a fast device go together in one submission, up to the budget; a pass of a slow one is cut into several. A frame that has
// begun is finished, or its reservoirs would be of two frames.
void PathRenderer::render_frames(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) {
    struct Part {
        ResamplingStage stage;
        shared::Dispatch dispatch;
        Region region;
    };
    std::vector<Part> parts;
    std::uint64_t work = 0;
    const auto flush = [&] {
        if (!parts.empty()) {
            queue_->submit(work, [&](const vk::raii::CommandBuffer& commands) {
                for (const Part& part : parts) {
                    full_barrier(commands);
                    record_dispatch(commands, stages_[static_cast<std::size_t>(part.stage)], layout_, bindings_,
                                    part.dispatch, part.region.width, part.region.height);
                }
            });
        }
        parts.clear();
        work = 0;
    };
    for (std::uint32_t frame = first; frame < first + count && !cancel.load(); ++frame) {
        for (const ResamplingStep& step : schedule_.next_frame(frame)) {
            SliceCursor cursor({0, 0, constants_.size.x, constants_.size.y}, frame, 1);
            while (!cursor.done()) {
                const Slice slice = cursor.next(slice_budget(), gpu_->ray_tracing.maxRayDispatchInvocationCount);
                if (work + slice.work() > slice_budget()) {
                    flush();
                }
                shared::Dispatch dispatch{};
                dispatch.origin = {slice.region.x, slice.region.y};
                dispatch.pass = step.pass;
                parts.push_back({step.stage, dispatch, slice.region});
                work += slice.work();
            }
        }
    }
    flush();
}

}  // namespace diptych
