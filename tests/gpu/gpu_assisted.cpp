// That GPU-assisted validation is on where it was asked for, and knows the layout that our shaders read.
#include <array>
#include <cstdlib>
#include <string>

#include "device/validation.h"
#include "gpu_fixture.h"
#include "memory/buffer.h"
#include "memory/readback.h"
#include "memory/upload.h"
#include "pipelines/compute_shader.h"
#include "test_shader_binaries.h"

namespace diptych::core::tests {
namespace {

using Usage = vk::BufferUsageFlagBits;

// tests/scripts/gpu_assisted.sh asks the layer for it in the environment, and so for every device of a process.
bool is_gpu_assisted() {
    const char* enabled = std::getenv("VK_LAYER_ENABLES");
    return enabled != nullptr && std::string(enabled).find("GPU_ASSISTED") != std::string::npos;
}

/// Reads element `index` of a buffer of two vec3 by its address.
shared::vec3 read_by_address(const Gpu& gpu, std::uint32_t index) {
    const std::array<shared::vec3, 2> vectors = {shared::vec3(1, 2, 3), shared::vec3(4, 5, 6)};
    Uploader uploader(gpu);
    const Buffer buffer = upload_array(gpu, uploader, Purpose::other, std::span<const shared::vec3>(vectors),
                                       Usage::eStorageBuffer | Usage::eShaderDeviceAddress);
    const Buffer arguments = upload_array(gpu, uploader, Purpose::other,
                                          std::span<const std::uint64_t>(&buffer.address, 1), Usage::eStorageBuffer);
    uploader.finish();
    const Buffer results = make_storage(gpu, sizeof(shared::vec3));
    ComputeShader shader(gpu, test_shader_binary("reads_by_address.comp"), 2);
    shader.run(std::array{&arguments, &results}, 1, index);
    return read_array<shared::vec3>(gpu, results).front();
}

}  // namespace

TEST_CASE("A vec3 that ends with its buffer is read by its address, and validation has nothing to say") {
    NEED_VULKAN();
    const std::shared_ptr<Gpu> gpu = open_test_gpu();
    const shared::vec3 last = read_by_address(*gpu, 1);
    CHECK((last.x == 4 && last.y == 5 && last.z == 6));
    check_no_validation_messages();
}

TEST_CASE("GPU-assisted validation reports a read beyond the end of a buffer by its address") {
    NEED_VALIDATION();
    if (!is_gpu_assisted()) {
        SKIP_TEST("GPU-assisted validation is not asked for (tests/scripts/gpu_assisted.sh)");
    }
    clear_validation_messages();
    read_by_address(*open_test_gpu(), 2);
    CHECK(validation_message_count() > 0);
    clear_validation_messages();
}

}  // namespace diptych::core::tests
