// That validation would speak, if there were something to say.
#include "device/validation.h"

#include "memory/buffer.h"
#include "commands/commands.h"
#include "gpu_fixture.h"

namespace diptych::core::tests {

TEST_CASE("Validation reports a write that races with another, and counts it") {
    NEED_VALIDATION();
    clear_validation_messages();
    {
        const auto opened = open_gpu({.device = "", .validation = true});
        const Gpu& gpu = *opened;
        const Buffer buffer = make_buffer(gpu, Purpose::other, 64, vk::BufferUsageFlagBits::eTransferDst, MemoryKind::device);
        run_commands(gpu, [&](const vk::raii::CommandBuffer& commands) {
            commands.fillBuffer(*buffer.handle, 0, 64, 1);
            commands.fillBuffer(*buffer.handle, 0, 64, 2);
        });
    }
    CHECK(validation_message_count() > 0);
    REQUIRE_FALSE(validation_messages().empty());
    CHECK_THAT(validation_messages().front(),
               Catch::Contains("SYNC-HAZARD-WRITE-AFTER-WRITE") || Catch::Contains("SYNC-HAZARD-WRITE_AFTER_WRITE"));
    clear_validation_messages();
    check_no_validation_messages();
}

}  // namespace diptych::core::tests
