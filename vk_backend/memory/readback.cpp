#include "memory/readback.h"

#include <cstring>

#include "commands/commands.h"

namespace diptych::core {

void read_buffer(const Gpu& gpu, const Buffer& buffer, std::span<std::byte> bytes) {
    if (bytes.empty()) {
        return;
    }
    const Buffer host =
        make_buffer(gpu, "reading results", bytes.size(), vk::BufferUsageFlagBits::eTransferDst, MemoryKind::readback);
    run_commands(gpu, [&](Recorder& recorder) {
        recorder.use({{Resource::readback, Unit::transfer, Effect::write}});
        recorder->copyBuffer(*buffer.handle, *host.handle, vk::BufferCopy{.size = bytes.size()});
        recorder.use({{Resource::readback, Unit::host, Effect::read}});
    });
    std::memcpy(bytes.data(), host.mapped, bytes.size());
}

}  // namespace diptych::core
