// A render shown while it grows, in a viewer that listens on the network: tev, or whatever speaks its protocol.
#pragma once

#include <string>

#include "image/image.h"

namespace diptych::core::app {

class LiveView {
public:
    /// Connects to "HOST:PORT", or "[HOST]:PORT" for an address with colons. Throws Error naming both and the reason.
    explicit LiveView(const std::string& endpoint);
    ~LiveView();
    LiveView(const LiveView&) = delete;
    LiveView& operator=(const LiveView&) = delete;

    /// Shows `image` (linear, three channels) under that name, in place of what was there. A viewer that is gone, or
    /// takes nothing for some seconds, costs a warning and is left alone from then on: the render matters more.
    void show(const std::string& name, const Image& image);

private:
    void send(const void* data, std::size_t size);

    std::string endpoint_;
    int socket_ = -1;
    std::string shown_;  // name and size of the picture that the viewer has
};

}  // namespace diptych::core::app
