// A render shown while it grows, in a viewer that listens on the network: tev, or whatever speaks its protocol.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "image/image.h"

namespace diptych::core::app {

class LiveView {
public:
    /// Connects to "HOST:PORT", or "[HOST]:PORT" for an address with colons. Throws Error naming both and the reason.
    explicit LiveView(const std::string& endpoint);
    ~LiveView();
    LiveView(const LiveView&) = delete;
    LiveView& operator=(const LiveView&) = delete;

    /// Shows `image` (linear, three channels) under that name, in place of what was there. Takes a tenth of a second at
    /// most, and ends as soon as `cancel` is set: a viewer that reads slowly gets some bands of rows now, and the next
    /// call goes on with the bands below them. A viewer that is gone, or takes nothing for some seconds, costs a warning
    /// and is left alone from then on: the render matters more.
    void show(const std::string& name, const Image& image, const std::atomic<bool>& cancel);

    /// Shows all of the final image, for which there are so many seconds, and half a second at least. A viewer that has not taken
    /// it by then costs a warning.
    void finish(const std::string& name, const Image& image, double seconds);

private:
    struct Deadline;

    // Each is false where the viewer is gone, or the deadline passes before it has taken what it was sent before.
    bool announce(const std::string& name, const Image& image, const Deadline& deadline);
    bool send_rows(const std::string& name, const Image& image, int first, int count, const Deadline& deadline);
    bool flush(const Deadline& deadline);

    void queue(std::vector<std::uint8_t> packet);
    void hang_up(const std::string& reason);

    std::string endpoint_;
    int socket_ = -1;
    std::string shown_;                 // name and size of the picture that the viewer has
    int next_row_ = 0;                  // of that picture: where the next band begins
    std::vector<std::uint8_t> unsent_;  // a packet: the viewer can use it only as a whole
    std::size_t sent_ = 0;              // bytes of it that the viewer has taken
    double last_progress_ = 0;          // when it last took some
    bool warned_ = false;
};

}  // namespace diptych::core::app
