// Compiled pipelines kept on disk between runs.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "device/gpu.h"

namespace diptych::core {

/// XDG_CACHE_HOME/diptych or ~/.cache/diptych, a file a device and driver version; empty where there is neither folder.
std::filesystem::path pipeline_cache_path(const Gpu& gpu);

/// The bytes behind a checked header; empty where the file is missing, cut short or altered: a driver need not survive
/// those.
std::vector<unsigned char> read_pipeline_cache(const std::filesystem::path& path);

/// Replaces the file whole. Failing to is no error: the next run compiles again.
void write_pipeline_cache(const std::filesystem::path& path, std::span<const unsigned char> bytes);

/// A cache with what the file holds.
vk::raii::PipelineCache open_pipeline_cache(const Gpu& gpu, const std::filesystem::path& path);

/// Writes the cache back if it differs from the file.
void save_pipeline_cache(const vk::raii::PipelineCache& cache, const std::filesystem::path& path);

}  // namespace diptych::core
