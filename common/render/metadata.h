// What a picture says of its own making, so that it can be made again.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "path/path_record.h"
#include "render/request.h"

namespace diptych::core {

/// How a render went.
struct RenderOutcome {
    std::string program;  // "diptych 0.1.0 (commit …)"
    std::string device;
    std::uint32_t spp = 0;  // that every pixel has been given
    bool interrupted = false;
    bool uneven = false;  // cut short within a sample: some pixels have more than `spp`
    double seconds = 0;
    std::uint64_t rays = 0;
    std::uint64_t nonfinite = 0;
};

/// As one word for a shell.
std::string shell_quoted(const std::string& word);

/// The command line that repeats a render of `spp` samples to the bit: every setting that matters, shell-quoted, files
/// as given.
std::string repeat_command(const RenderRequest& request, std::uint32_t spp);

/// The command line that replays one of its paths.
std::string replay_command(const RenderRequest& request, const shared::PathQuery& path);

/// Values by name; "command" is repeat_command of what was reached.
std::map<std::string, std::string> render_metadata(const RenderRequest& request, const RenderOutcome& outcome);

}  // namespace diptych::core
