// `diptych info --devices`.
#pragma once

namespace diptych::core::app {

/// Prints the CPU and every Vulkan device, with what a device lacks; returns the exit code.
int print_devices(bool json);

}  // namespace diptych::core::app
