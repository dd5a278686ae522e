// What control groups, such as those of containers, let this process have of the machine's memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace diptych::core {

struct MemoryGroup {
    std::uint64_t limit = 0;  // bytes
    std::uint64_t used = 0;
};

/// The groups with a limit, of version 2 and of version 1: the process's own and those around it. `root` is where the
/// system's files lie.
std::vector<MemoryGroup> memory_groups(const std::filesystem::path& root = "/");

/// The machine's memory, or the least limit of a group where that is less. In bytes.
std::uint64_t memory_of_process(const std::filesystem::path& root = "/");

}  // namespace diptych::core
