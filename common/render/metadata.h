// The metadata of a picture: how it was made, so that it can be made again.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "render/request.h"
#include "render/sample_ranges.h"

namespace diptych::core {

/// The front end that makes a picture.
struct PictureMaker {
    std::string program;  // "diptych 0.1.0 (commit …)"
    /// How its user repeats a render of `spp` samples to the bit: a command line, for example. May be empty.
    std::function<std::string(const RenderRequest& request, std::uint32_t spp)> command;
};

/// How a render went.
struct RenderOutcome {
    PictureMaker maker;
    std::string device;
    std::uint32_t spp = 0;  // that every pixel has been given
    SampleRanges samples;   // which; none where frames go on from one another
    std::string fingerprint;  // of the scene, where the sums are kept
    bool interrupted = false;
    std::uint64_t look_at = 0;  // ProgressiveResult's
    bool uneven = false;  // cut short within a sample: some pixels have more than `spp`
    std::uint64_t uneven_from = 0;  // the first sample that only some pixels have
    double seconds = 0;
    std::uint64_t rays = 0;
    std::uint64_t nonfinite = 0;
};

/// Values by name. "command" is the maker's command for the samples that were reached; left out without a command.
std::map<std::string, std::string> render_metadata(const RenderRequest& request, const RenderOutcome& outcome);

/// The settings that such values tell; what they leave out has its default. Throws Error where one is no setting's.
RenderSettings settings_in(const std::map<std::string, std::string>& metadata);

}  // namespace diptych::core
