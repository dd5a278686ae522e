// Whether both panels see the same scene, while they render it.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <string>

#include "view/panel_worker.h"

namespace diptych::core::app {

/// The looks of a running test: its z wanders as samples come, so only what hardly ever happens by chance is called
/// out.
enum class Agreement {
    waiting,     // not the same picture, or too few samples yet
    correlated,  // chains: their spread says nothing of the error
    agree,       // |z| below 3
    doubtful,    // below 4.5
    differ,
};

struct VerificationLight {
    Agreement agreement = Agreement::waiting;
    Rgb z{};             // Welch's, of each channel's image mean, first panel minus second; 0 while waiting
    double largest = 0;  // |z| of the worst channel
    double p = 1;        // of it, over three channels (Šidák)
    std::string text;    // "z = 0.8: agree", "waiting for 16 spp on both"
};

/// Samples a pixel of each panel before anything is said.
inline constexpr std::uint32_t least_verified_samples = 16;

/// Of figures of one version and one size.
VerificationLight verification_light(const PanelShot& first, const PanelShot& second);

/// A panel's estimated error as it fell, for a plot.
struct ErrorPoint {
    double seconds = 0;  // since the picture began
    std::uint32_t spp = 0;
    double relmse = 0;
};

/// The last so many points; a new picture begins anew, a new version of the same one (paused, another panel) goes on.
class ErrorHistory {
public:
    explicit ErrorHistory(std::size_t capacity = 512) : capacity_(capacity) {}

    /// Adds what the shot's figures know beyond the last; `now` in seconds of any steady clock.
    void add(const PanelShot& shot, double now);

    const std::deque<ErrorPoint>& points() const { return points_; }

private:
    std::size_t capacity_;
    std::deque<ErrorPoint> points_;
    std::uint64_t version_ = 0;
    RenderedState state_;  // of that version
    int width_ = 0;        // of its film: previews are other pictures
    double begin_ = 0;
};

}  // namespace diptych::core::app
