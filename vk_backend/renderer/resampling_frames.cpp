#include <algorithm>
#include <vector>

#include "renderer/path_renderer.h"
#include "memory/readback.h"

namespace diptych::core {

// On a fast device one submission holds several passes, up to the budget; on a slow device a pass is split. A frame
// that has begun is finished, because otherwise its reservoirs would mix two frames. Waves are submitted separately.
void PathRenderer::render_frames(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) {
    std::vector<TimedPart> parts;
    std::uint64_t work = 0;
    const auto flush = [&] {
        if (!parts.empty()) {
            queue_->submit(work, parts);
        }
        parts.clear();
        work = 0;
    };
    for (std::uint32_t frame = first; frame < first + count && !cancel.load(); ++frame) {
        for (const ResamplingStep& step : schedule_.next_frame(frame)) {
            reservoir_set_ = resulting_set(step);
            SliceCursor cursor({0, 0, constants_.size.x, constants_.size.y}, frame, 1);
            while (!cursor.done()) {
                shared::Dispatch dispatch{};
                dispatch.pass = step.pass;
                if (step.stage == ResamplingStage::shade && goes_in_waves()) {
                    flush();
                    submit_slice(*queue_, wave_pipelines_, bindings_, next_slice(cursor, speed_), dispatch, step.place);
                    continue;
                }
                const Slice slice = cursor.next(slice_budget(), pixel_limit(step.stage));
                if (work + slice.work() > slice_budget() || parts.size() == TimedQueue::most_parts) {
                    flush();
                }
                parts.push_back({step.place, [this, dispatch, slice, stage = step.stage](Recorder& recorder) {
                                     record_stage(recorder, stage, slice, dispatch);
                                 }});
                work += slice.work();
            }
            if (hook_) {
                flush();
                queue_->drain();
                show_reservoirs(step);
            }
        }
    }
    flush();
}

std::uint64_t PathRenderer::pixel_limit(ResamplingStage stage) const {
    return stage == ResamplingStage::shade ? most_invocations(*gpu_) : gpu_->ray_tracing.maxRayDispatchInvocationCount;
}

void PathRenderer::record_stage(Recorder& recorder, ResamplingStage stage, const Slice& slice,
                                shared::Dispatch dispatch) const {
    tell(dispatch, slice);
    if (stage == ResamplingStage::shade) {
        SliceWaves(wave_pipelines_, layout_, bindings_, waves_, slice, dispatch).begin(recorder);
    } else if (stage == ResamplingStage::candidates) {
        record_candidates(recorder, candidates_, layout_, bindings_, *resampling_, dispatch);
    } else if (const auto found = computed_.find(stage); found != computed_.end()) {
        compute_region(recorder, *found->second, layout_, bindings_, dispatch);
    } else {
        record_dispatch(recorder, *traced_.at(stage), layout_, bindings_, dispatch, slice.region.width,
                        slice.region.height);
    }
}

void PathRenderer::show_reservoirs(const ResamplingStep& step) {
    const auto all = read_array<shared::Reservoir>(*gpu_, resampling_->reservoirs);
    const std::size_t pixels = std::size_t{constants_.size.x} * constants_.size.y;
    hook_(step, std::span(all).subspan(resulting_set(step) * pixels, pixels));
}

std::vector<PassTime> PathRenderer::pass_times() const {
    std::vector<PassTime> times;
    for (const std::string& pass : pass_names(constants_)) {
        if (gpu_->tick_seconds > 0) {
            times.push_back({pass, queue_->seconds_of(times.size())});
        }
    }
    return times;
}

}  // namespace diptych::core
