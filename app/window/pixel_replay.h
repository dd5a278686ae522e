// A path of the pixel that was clicked, on every panel there is.
#pragma once

#include <future>
#include <optional>
#include <string>
#include <vector>

#include "measure/replay.h"
#include "view/frame_loop.h"

namespace diptych::core::app {

class PixelReplay {
public:
    /// Asks the panels for that path of the picture as it is now, under the one seed; what was asked before is
    /// forgotten.
    void ask(const FrameLoop& loop, const shared::PathQuery& query, std::uint32_t seed);
    void forget();

    /// Once a frame: takes what the panels have answered; true when the last one has.
    bool update();

    bool asked() const { return asked_; }
    bool waiting() const { return !answers_.empty(); }
    const shared::PathQuery& query() const { return query_; }
    /// What has come so far.
    const Replay& result() const { return result_; }
    const std::string& error() const { return error_; }

private:
    struct Answer {
        std::string backend;
        std::string device;
        std::future<RecordedPath> path;
    };

    void take(Answer& answer);

    bool asked_ = false;
    shared::PathQuery query_{};
    std::vector<Answer> answers_;
    Replay result_;
    std::string error_;
};

}  // namespace diptych::core::app
