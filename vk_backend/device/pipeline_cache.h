// Compiled pipelines kept on disk between runs.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "device/gpu.h"

namespace diptych::core {

/// The cache file in XDG_CACHE_HOME/diptych or ~/.cache/diptych, one for each device and driver version; empty if
/// neither folder is defined.
std::filesystem::path pipeline_cache_path(const Gpu& gpu);

/// The contents after a header that is checked. Empty if the file is missing, truncated or altered, because a driver
/// may crash on such data.
std::vector<unsigned char> read_pipeline_cache(const std::filesystem::path& path);

/// Replaces the whole file. A failure is ignored: the next run compiles again.
void write_pipeline_cache(const std::filesystem::path& path, std::span<const unsigned char> bytes);

/// Creates a pipeline cache from the file's contents.
vk::raii::PipelineCache open_pipeline_cache(const Gpu& gpu, const std::filesystem::path& path);

/// Writes the cache to the file if its contents changed.
void save_pipeline_cache(const vk::raii::PipelineCache& cache, const std::filesystem::path& path);

}  // namespace diptych::core
