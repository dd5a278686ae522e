#include "memory/upload.h"

#include <algorithm>
#include <cstring>

#include "commands/commands.h"
#include "language/compat.h"

namespace diptych::core {
namespace {

constexpr std::uint64_t least_staging = std::uint64_t{64} << 10U;

}  // namespace

Uploader::Uploader(const Gpu& gpu, std::uint64_t capacity)
    : gpu_(gpu),
      staging_(make_largest_buffer(gpu, Purpose::staging, capacity, least_staging,
                                   vk::BufferUsageFlagBits::eTransferSrc, MemoryKind::upload)) {}

void Uploader::upload(const Buffer& buffer, std::span<const std::byte> bytes) {
    std::uint64_t done = 0;
    while (done < bytes.size()) {
        if (used_ == staging_.size) {
            finish();
        }
        const std::uint64_t count = std::min<std::uint64_t>(bytes.size() - done, staging_.size - used_);
        std::memcpy(static_cast<std::byte*>(staging_.mapped) + used_, bytes.data() + done, count);
        const std::uint64_t start = MUTANT(UPLOAD_AT_START, done, 0);
        copies_.push_back({*buffer.handle, {.srcOffset = used_, .dstOffset = start, .size = count}});
        used_ += count;
        done += count;
    }
}

void Uploader::finish() {
    if (!copies_.empty()) {
        run_commands(gpu_, [&](Recorder& recorder) {
            for (const Copy& copy : copies_) {  // the copies do not overlap
                recorder->copyBuffer(*staging_.handle, copy.target, copy.region);
            }
        });
    }
    copies_.clear();
    used_ = 0;
}

}  // namespace diptych::core
