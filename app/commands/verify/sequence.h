// `verify --frame`: which frames of a scene that moves are judged.
#pragma once

#include <CLI/CLI.hpp>

#include "commands/verify/options.h"

namespace diptych::core::app {

/// --frame, --fps, --start, --orbit, --frame-spp; none of them goes with `paired`.
void add_sequence_options(CLI::App& command, VerifyOptions& options, CLI::Option& paired);

/// Puts options.frames in order, and the default in place where a sequence is asked for without them. Throws Error.
void resolve_frames(VerifyOptions& options);

}  // namespace diptych::core::app
