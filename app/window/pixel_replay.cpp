#include "window/pixel_replay.h"

#include <chrono>

namespace diptych::app {

namespace {

constexpr double tolerance = 1e-3;  // that of `replay`

}  // namespace

void PixelReplay::forget() {
    asked_ = false;
    answers_.clear();
    result_ = {};
    error_.clear();
}

void PixelReplay::ask(const FrameLoop& loop, const shared::PathQuery& query) {
    forget();
    asked_ = true;
    query_ = query;
    for (const Panel panel : {Panel::cpu, Panel::vulkan}) {
        if (PanelWorker* worker = loop.worker(panel)) {
            const std::uint32_t seed = loop.shot(panel)->state.request.settings.seed;
            answers_.push_back({loop.shot(panel)->backend, loop.shot(panel)->device, worker->record_path(query, seed)});
        }
    }
}

bool PixelReplay::update() {
    if (answers_.empty()) {
        return false;
    }
    for (const Answer& answer : answers_) {
        if (answer.path.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
            return false;
        }
    }
    Replay replay;
    replay.tolerance = tolerance;
    for (Answer& answer : answers_) {
        try {
            replay.paths.push_back(answer.path.get());
            replay.backends.push_back(answer.backend);
            replay.devices.push_back(answer.device);
        } catch (const Error& error) {
            error_ = error.what();
        }
    }
    if (replay.paths.size() > 1) {
        replay.parting = find_parting(replay.paths[0], replay.paths[1], tolerance);
    }
    answers_.clear();
    result_ = std::move(replay);
    return true;
}

}  // namespace diptych::app
