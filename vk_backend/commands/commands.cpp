#include "commands/commands.h"

#include <cstdint>
#include <exception>
#include <limits>

namespace diptych::core {

CommandSlot::CommandSlot(const Gpu& gpu)
    : gpu_(gpu), pool_(gpu.device.createCommandPool({.queueFamilyIndex = gpu.queue_family})),
      fence_(gpu.device.createFence({})) {
    commands_ = std::move(gpu.device.allocateCommandBuffers({.commandPool = *pool_, .commandBufferCount = 1}).front());
}

void CommandSlot::submit(const Record& record) {
    pool_.reset();
    commands_.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    Recorder recorder(commands_);
    record(recorder);
    commands_.end();
    const vk::SubmitInfo info{.commandBufferCount = 1, .pCommandBuffers = &*commands_};
    core::submit(gpu_, info, *fence_);
    in_flight_ = true;
}

void CommandSlot::wait() {
    if (!in_flight_) {
        return;
    }
    const vk::Result result = gpu_.device.waitForFences(*fence_, VK_TRUE, std::numeric_limits<std::uint64_t>::max());
    if (result != vk::Result::eSuccess) {
        throw Error("Vulkan device " + gpu_.name + ": waiting for it gave " + vk::to_string(result));
    }
    gpu_.device.resetFences(*fence_);
    in_flight_ = false;
}

CommandRing::~CommandRing() {
    try {
        drain();
    } catch (const std::exception&) {  // the device is lost, so nothing runs any more
    }
}

void CommandRing::submit(const Record& record) {
    CommandSlot& slot = slots_[next_];
    next_ = (next_ + 1) % slots_.size();
    slot.wait();
    slot.submit(record);
}

void CommandRing::drain() {
    for (CommandSlot& slot : slots_) {
        slot.wait();
    }
}

void run_commands(const Gpu& gpu, const Record& record) {
    CommandSlot slot(gpu);
    slot.submit(record);
    slot.wait();
}

}  // namespace diptych::core
