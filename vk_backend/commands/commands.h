// Recording and submitting commands.
#pragma once

#include <array>
#include <functional>

#include "device/gpu.h"
#include "commands/recorder.h"

namespace diptych::core {

using Record = std::function<void(Recorder&)>;

/// A command buffer with a fence, both reused.
class CommandSlot {
public:
    explicit CommandSlot(const Gpu& gpu);
    ~CommandSlot();  // waits for the submission
    CommandSlot(const CommandSlot&) = delete;
    CommandSlot& operator=(const CommandSlot&) = delete;

    /// Records and submits; the submission begins with a barrier. The slot must not be in flight.
    void submit(const Record& record);
    /// Waits for the submission, if there is one.
    void wait();
    bool in_flight() const { return in_flight_; }

private:
    const Gpu& gpu_;
    vk::raii::CommandPool pool_;
    vk::raii::CommandBuffer commands_ = nullptr;
    vk::raii::Fence fence_;
    bool in_flight_ = false;
};

/// Submissions without waiting. Each runs after everything submitted before it and before everything submitted later.
class CommandRing {
public:
    explicit CommandRing(const Gpu& gpu) : slots_{CommandSlot(gpu), CommandSlot(gpu)} {}

    /// Records and submits. First waits for the older of two submissions in flight.
    void submit(const Record& record);
    /// Waits for all submissions.
    void drain();

private:
    std::array<CommandSlot, 2> slots_;
    std::size_t next_ = 0;
};

/// Records, submits, waits.
void run_commands(const Gpu& gpu, const Record& record);

}  // namespace diptych::core
