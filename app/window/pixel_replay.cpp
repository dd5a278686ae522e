#include "window/pixel_replay.h"

#include <chrono>

#include "console/option_names.h"

namespace diptych::core::app {

namespace {

constexpr double tolerance = 1e-3;  // that of `replay`

}  // namespace

void PixelReplay::forget() {
    asked_ = false;
    answers_.clear();
    result_ = {};
    error_.clear();
}

void PixelReplay::ask(const FrameLoop& loop, const shared::PathQuery& query, std::uint32_t seed) {
    forget();
    asked_ = true;
    query_ = query;
    result_.tolerance = tolerance;
    for (const Panel panel : {Panel::cpu, Panel::vulkan}) {
        if (PanelWorker* worker = loop.worker(panel)) {
            // One that was never shown has not said what it is.
            answers_.push_back(
                {panel == Panel::cpu ? "cpu" : "vulkan", loop.shot(panel)->device, worker->record_path(query, seed)});
        }
    }
}

bool PixelReplay::update() {
    bool any = false;
    for (auto answer = answers_.begin(); answer != answers_.end();) {
        if (answer->path.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
            ++answer;
            continue;
        }
        take(*answer);
        answer = answers_.erase(answer);
        any = true;
    }
    return any && answers_.empty();
}

void PixelReplay::take(Answer& answer) {
    try {
        // The CPU's in front, whichever comes first.
        const auto place = answer.backend == "cpu" ? 0 : static_cast<std::ptrdiff_t>(result_.paths.size());
        result_.paths.insert(result_.paths.begin() + place, answer.path.get());
        result_.backends.insert(result_.backends.begin() + place, answer.backend);
        result_.devices.insert(result_.devices.begin() + place, answer.device);
    } catch (const Error& error) {
        error_ = with_option_names(error.what());
    }
    compare_paths(result_);
}

}  // namespace diptych::core::app
