#include "console/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <utility>

#include "console/output.h"
#include "console/report.h"

namespace diptych::core::app {

std::string clock_text(double seconds) {
    const long long whole = std::llround(std::ceil(seconds));
    return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                        : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string progress_text(const Progress& progress, std::uint32_t target_spp) {
    std::string text =
        target_spp > 0 ? fmt::format("{}/{} spp", progress.spp, target_spp) : fmt::format("{} spp", progress.spp);
    text += fmt::format("  {}samples/s", with_prefix(progress.samples_per_second));
    if (progress.rays_per_second > 0) {
        text += fmt::format("  {}ray/s", with_prefix(progress.rays_per_second));
    }
    text += "  ETA " + (std::isfinite(progress.eta_seconds) ? clock_text(progress.eta_seconds) : "?");
    if (progress.relmse) {
        text += fmt::format("  relMSE {:.1e}", *progress.relmse);
    }
    return text;
}

std::string ProgressLine::text(const Progress& progress) const {
    return label_ + progress_text(progress, target_spp_);
}

ProgressLine::ProgressLine(std::uint32_t target_spp, std::string label)
    : target_spp_(target_spp), label_(std::move(label)), terminal_(isatty(STDERR_FILENO) == 1),
      next_(terminal_ ? 0 : first_sparse_line) {}

ProgressLine::~ProgressLine() {
    if (latest_.spp == 0) {
        return;
    }
    if (terminal_) {
        print_message("\r{}\x1b[K\n", text(latest_));
    } else if (latest_.spp != shown_.spp) {
        print_message("{}\n", text(latest_));
    }
}

void ProgressLine::show(const Progress& progress) {
    latest_ = progress;
    if (progress.seconds < next_) {
        return;
    }
    shown_ = progress;
    next_ = terminal_ ? progress.seconds + terminal_interval : 2 * progress.seconds;
    print_message("{}{}{}", terminal_ ? "\r" : "", text(progress), terminal_ ? "\x1b[K" : "\n");
}

}  // namespace diptych::core::app
