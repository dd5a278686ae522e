// verify --random: the renderers compared on scenes drawn at random.
#pragma once

#include "commands/verify/options.h"

namespace diptych::core::app {

/// Adds --random to `command`, after all other options of verify.
void add_random_option(CLI::App& command, VerifyOptions& options);

/// Returns the exit code. Throws Error and NoDevice.
int verify_random(const VerifyOptions& options);

}  // namespace diptych::core::app
