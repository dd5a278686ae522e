// How a render is getting on, in one line on stderr.
#pragma once

#include <string>

#include "render/progressive.h"

namespace diptych::core::app {

/// Seconds from one redrawing to the next on a terminal, and until the first line elsewhere.
inline constexpr double terminal_interval = 0.2;
inline constexpr double first_sparse_line = 2;

/// "1:02", or "1:00:02" from an hour on.
std::string clock_text(double seconds);

/// "128/1024 spp  12.3 Msamples/s  45.6 Mray/s  ETA 0:12  relMSE 1.2e-03"; `target_spp` 0 is unknown.
std::string progress_text(const Progress& progress, std::uint32_t target_spp);

/// `label` stands first. Redrawn in place on a terminal; elsewhere a line after 2 seconds and at each doubling of the
/// time. Ends its line when it dies.
class ProgressLine {
public:
    explicit ProgressLine(std::uint32_t target_spp, std::string label = "");
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void show(const Progress& progress);

private:
    std::string text(const Progress& progress) const;

    std::uint32_t target_spp_;
    std::string label_;
    bool terminal_;
    double next_;
    Progress latest_;
    Progress shown_;
};

}  // namespace diptych::core::app
