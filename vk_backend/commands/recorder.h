// Commands of one submission, with the barriers that they need between them.
#pragma once

#include <initializer_list>

#include "commands/hazards.h"
#include "device/vulkan_headers.h"

namespace diptych::core {

/// Whoever records a command says first what it uses. Within a submission, barriers come from that alone.
class Recorder {
public:
    /// Begins with a barrier for all that was submitted before, whatever it was.
    explicit Recorder(const vk::raii::CommandBuffer& commands);
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// Of the next pass, or command: records a barrier where there is a hazard. `more` are uses beside those that its
    /// shaders declare.
    void use(std::span<const Use> uses, std::initializer_list<Use> more = {});
    void use(std::initializer_list<Use> uses) { use(std::span<const Use>(), uses); }

    operator const vk::raii::CommandBuffer&() const { return commands_; }
    const vk::raii::CommandBuffer* operator->() const { return &commands_; }

private:
    const vk::raii::CommandBuffer& commands_;
    Hazards hazards_;
};

}  // namespace diptych::core
