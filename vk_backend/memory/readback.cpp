#include "memory/readback.h"

#include <algorithm>
#include <cstring>

#include "commands/commands.h"

namespace diptych::core {
namespace {

// What is read at a time, so that the results of a large picture need no second picture's room.
constexpr std::uint64_t most_at_once = std::uint64_t{64} << 20U;
constexpr std::uint64_t least_at_once = std::uint64_t{64} << 10U;

}  // namespace

void read_buffer(const Gpu& gpu, const Buffer& buffer, std::span<std::byte> bytes) {
    if (bytes.empty()) {
        return;
    }
    const Buffer host = make_largest_buffer(gpu, Purpose::readback, std::min<std::uint64_t>(bytes.size(), most_at_once),
                                            least_at_once, vk::BufferUsageFlagBits::eTransferDst, MemoryKind::readback);
    for (std::uint64_t done = 0; done < bytes.size(); done += host.size) {
        const std::uint64_t count = std::min<std::uint64_t>(bytes.size() - done, host.size);
        run_commands(gpu, [&](Recorder& recorder) {
            recorder.use({{Resource::readback, Unit::transfer, Effect::write}});
            recorder->copyBuffer(*buffer.handle, *host.handle, vk::BufferCopy{.srcOffset = done, .size = count});
            recorder.use({{Resource::readback, Unit::host, Effect::read}});
        });
        std::memcpy(bytes.data() + done, host.mapped, count);
    }
}

}  // namespace diptych::core
