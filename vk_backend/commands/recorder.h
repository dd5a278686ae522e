// Commands of one submission, with the barriers between them.
#pragma once

#include <initializer_list>

#include "commands/hazards.h"
#include "device/vulkan_headers.h"

namespace diptych::core {

/// Before each command its uses are declared. Within a submission, barriers are derived from these declarations alone.
class Recorder {
public:
    /// Begins with a barrier for everything submitted before.
    explicit Recorder(const vk::raii::CommandBuffer& commands);
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// Declares the uses of the next pass or command, and records a barrier if there is a hazard. `more` are uses
    /// beside those that the pass's shaders declare.
    void use(std::span<const Use> uses, std::initializer_list<Use> more = {});
    void use(std::initializer_list<Use> uses) { use(std::span<const Use>(), uses); }

    operator const vk::raii::CommandBuffer&() const { return commands_; }
    const vk::raii::CommandBuffer* operator->() const { return &commands_; }

private:
    const vk::raii::CommandBuffer& commands_;
    Hazards hazards_;
};

}  // namespace diptych::core
