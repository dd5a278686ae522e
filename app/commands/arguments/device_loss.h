// --on-device-lost.
#pragma once

#include <string>

#include "render/device_loss.h"
#include "render/request.h"

namespace CLI {
class App;
class Option;
}

namespace diptych::core::app {

/// `with_cpu`: the CPU may go on in the device's place, which a command that compares backends cannot use.
CLI::Option* add_device_loss_option(CLI::App& command, std::string& choice, bool with_cpu);

/// Losses are reported as warnings. Throws Error for an unknown name.
DeviceLossPolicy device_loss_policy(const std::string& choice, bool with_cpu, const RenderRequest& request);

}  // namespace diptych::core::app
