#include "readback.h"

#include <cstring>

#include "commands.h"

namespace diptych {

void read_buffer(const Gpu& gpu, const Buffer& buffer, std::span<std::byte> bytes) {
    if (bytes.empty()) {
        return;
    }
    const Buffer host =
        make_buffer(gpu, "reading results", bytes.size(), vk::BufferUsageFlagBits::eTransferDst, MemoryKind::readback);
    run_commands(gpu, [&](const vk::raii::CommandBuffer& commands) {
        full_barrier(commands);
        commands.copyBuffer(*buffer.handle, *host.handle, vk::BufferCopy{.size = bytes.size()});
        const vk::MemoryBarrier to_host{.srcAccessMask = vk::AccessFlagBits::eTransferWrite,
                                        .dstAccessMask = vk::AccessFlagBits::eHostRead};
        commands.pipelineBarrier(vk::PipelineStageFlagBits::eTransfer, vk::PipelineStageFlagBits::eHost, {}, to_host,
                                 {}, {});
    });
    std::memcpy(bytes.data(), host.mapped, bytes.size());
}

}  // namespace diptych
