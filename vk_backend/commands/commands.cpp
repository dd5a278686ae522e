#include "commands/commands.h"

#include <exception>

namespace diptych::core {

CommandSlot::CommandSlot(const Gpu& gpu)
    : gpu_(gpu), pool_(gpu.device.createCommandPool({.queueFamilyIndex = gpu.queue_family})),
      fence_(gpu.device.createFence({})) {
    commands_ = std::move(gpu.device.allocateCommandBuffers({.commandPool = *pool_, .commandBufferCount = 1}).front());
}

CommandSlot::~CommandSlot() {
    try {
        wait();
    } catch (const std::exception&) {  // the device is lost, so nothing runs any more
    }
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
    wait_for(gpu_, *fence_);
    gpu_.device.resetFences(*fence_);
    in_flight_ = false;
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
