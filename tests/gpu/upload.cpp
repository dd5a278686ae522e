// What is uploaded through a staging buffer is what the device then holds.
#include "memory/upload.h"

#include <numeric>

#include "gpu_fixture.h"
#include "memory/readback.h"

namespace diptych::core::tests {
namespace {

std::vector<std::uint32_t> numbers(std::size_t count, std::uint32_t first) {
    std::vector<std::uint32_t> out(count);
    std::iota(out.begin(), out.end(), first);
    return out;
}

}  // namespace

TEST_CASE("An upload larger than the staging buffer arrives whole, among others") {
    NEED_VULKAN();
    const auto gpu = open_test_gpu();
    const auto usage = vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferSrc;
    // In elements of 4 bytes: whole staging buffers, parts of one, and what begins in one and ends in a later one.
    for (const std::uint64_t staged : {1U, 64U, 1000U}) {
        Uploader uploader(*gpu, 4 * staged);
        std::vector<std::vector<std::uint32_t>> sent;
        std::vector<Buffer> buffers;
        for (const std::size_t count : {1U, 63U, 64U, 65U, 1000U, 3U, 2777U, 0U, 128U}) {
            const auto first = 1000003U * static_cast<std::uint32_t>(sent.size() + 1);
            sent.push_back(numbers(staged == 1 ? count % 100 : count, first));
            const std::span<const std::uint32_t> all(sent.back());
            buffers.push_back(upload_array(*gpu, uploader, Purpose::other, all, usage));
        }
        uploader.finish();
        for (std::size_t i = 0; i < sent.size(); ++i) {
            INFO("staging " << staged << ", upload " << i << " of " << sent[i].size() << " numbers");
            CHECK(read_array<std::uint32_t>(*gpu, buffers[i]) == sent[i]);
        }
        // Overwritten later, through the same staging buffer.
        const std::vector<std::uint32_t> other = numbers(sent[6].size(), 7);
        uploader.upload(buffers[6], std::as_bytes(std::span(other)));
        uploader.finish();
        CHECK(read_array<std::uint32_t>(*gpu, buffers[6]) == other);
    }
    check_no_validation_messages();
}

}  // namespace diptych::core::tests
