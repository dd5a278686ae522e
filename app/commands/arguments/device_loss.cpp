#include "commands/arguments/device_loss.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "console/report.h"
#include "error.h"
#include "session/make_renderer.h"

namespace diptych::core::app {

CLI::Option* add_device_loss_option(CLI::App& command, std::string& choice, bool with_cpu) {
    return command
        .add_option("--on-device-lost", choice,
                    with_cpu ? "When the Vulkan device is lost: stop and save, retry on the device, or let the cpu go on"
                             : "When the Vulkan device is lost: stop, or retry the run on the device")
        ->type_name(with_cpu ? "stop|retry|cpu" : "stop|retry")
        ->capture_default_str();
}

DeviceLossPolicy device_loss_policy(const std::string& choice, bool with_cpu, const RenderRequest& request) {
    DeviceLossPolicy policy;
    if (choice == "retry") {
        policy.choice = OnDeviceLost::retry;
    } else if (choice == "cpu" && with_cpu) {
        policy.choice = OnDeviceLost::cpu;
    } else if (choice != "stop") {
        throw Error(fmt::format("--on-device-lost {}: there are only stop, retry{}", choice, with_cpu ? ", cpu" : ""));
    }
    RenderRequest on_cpu = request;
    on_cpu.backend = "cpu";
    on_cpu.device.clear();
    on_cpu.validation = false;
    policy.cpu = renderer_maker_of(on_cpu);
    policy.report = report_warning;
    return policy;
}

}  // namespace diptych::core::app
