#include "device/pipeline_cache.h"

#include <filesystem>
#include <fstream>

#include "gpu_fixture.h"

namespace diptych::core::tests {
namespace {

std::filesystem::path scratch_file() {
    const auto folder =
        std::filesystem::temp_directory_path() / ("diptych-cache-" + std::to_string(std::random_device()()));
    std::filesystem::create_directories(folder);
    return folder / "sub" / "pipelines";
}

}  // namespace

TEST_CASE("A pipeline cache file is read back whole, or not at all once it is damaged") {
    const std::filesystem::path path = scratch_file();
    const std::vector<unsigned char> bytes = {1, 2, 3, 4, 5, 250};
    CHECK(read_pipeline_cache(path).empty());
    write_pipeline_cache(path, bytes);
    CHECK(read_pipeline_cache(path) == bytes);
    const std::uintmax_t size = std::filesystem::file_size(path);
    {
        std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(static_cast<std::streamoff>(size) - 2);
        file.put('x');
    }
    CHECK(read_pipeline_cache(path).empty());
    write_pipeline_cache(path, bytes);
    std::filesystem::resize_file(path, size - 1);
    CHECK(read_pipeline_cache(path).empty());
    std::filesystem::remove_all(path.parent_path().parent_path());
}

TEST_CASE("A pipeline cache is saved and opened again, and a folder that cannot be written to is no error") {
    NEED_VULKAN();
    const std::filesystem::path path = scratch_file();
    const auto opened = open_test_gpu();
    const Gpu& gpu = *opened;
    {
        const vk::raii::PipelineCache cache = open_pipeline_cache(gpu, path);
        save_pipeline_cache(cache, path);
        CHECK(read_pipeline_cache(path) == cache.getData());
    }
    CHECK_NOTHROW(open_pipeline_cache(gpu, path));
    CHECK_NOTHROW(save_pipeline_cache(open_pipeline_cache(gpu, path), "/proc/nowhere/pipelines"));
    std::filesystem::remove_all(path.parent_path().parent_path());
    check_no_validation_messages();
}

}  // namespace diptych::core::tests
