// What happens in a view, one JSON line an event, for programs that drive it.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "window/interface.h"

namespace diptych::core::app {

class ViewLog {
public:
    /// "" keeps nothing, "-" is stdout. Throws Error where the file cannot be written.
    explicit ViewLog(const std::string& file);

    /// One line, at once: {"event": ..., "seconds": ...} and what `details` holds.
    void write(const char* event, nlohmann::ordered_json details = nlohmann::ordered_json::object());

    /// Once a frame: what has changed since the last. Events: integrator, panel, layer, resized, applied (a version
    /// seen on a panel), spp (at 1, 2, 4, … of a picture), placed (a named control that stands somewhere else).
    void follow(const InterfaceFacts& facts, const ViewState& state, const InterfaceState& interface, double now);

private:
    struct Closer {
        void operator()(std::FILE* file) const;
    };
    struct Seen {
        std::uint64_t version = 0;
        std::uint32_t spp = 0;
        int divisor = 0;
    };

    std::unique_ptr<std::FILE, Closer> file_;
    double begin_ = -1;
    double now_ = 0;
    std::string integrator_;
    std::string panel_;
    std::string layer_;
    int width_ = 0;
    int height_ = 0;
    std::array<Seen, 2> seen_;
    std::map<std::string, ImVec2> placed_;
};

}  // namespace diptych::core::app
