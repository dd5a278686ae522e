#include "memory_groups.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>

#include <unistd.h>

namespace diptych::core {
namespace {

namespace fs = std::filesystem;

std::optional<std::uint64_t> number_in_file(const fs::path& path) {
    std::uint64_t number = 0;
    std::ifstream file(path);
    return file >> number ? std::optional(number) : std::nullopt;  // "max" is no number
}

struct Controller {
    const char* folder;  // in sys/fs/cgroup
    const char* limit;
    const char* used;
};

constexpr Controller version_2 = {"", "memory.max", "memory.current"};
constexpr Controller version_1 = {"memory", "memory.limit_in_bytes", "memory.usage_in_bytes"};

/// Adds the group of that path and those around it. In a container the path may be one of the host, which is not there:
/// then the outermost group that the container sees is its own.
void add_groups(const fs::path& root, const Controller& controller, fs::path group, std::vector<MemoryGroup>& groups) {
    const fs::path top = root / "sys/fs/cgroup" / controller.folder;
    group = group.relative_path();
    while (true) {
        const std::optional<std::uint64_t> limit = number_in_file(top / group / controller.limit);
        const std::optional<std::uint64_t> used = number_in_file(top / group / controller.used);
        if (limit && used) {
            groups.push_back({*limit, *used});
        }
        if (group.empty()) {
            return;
        }
        group = group.parent_path();
    }
}

}  // namespace

std::vector<MemoryGroup> memory_groups(const fs::path& root) {
    std::vector<MemoryGroup> groups;
    std::ifstream file(root / "proc/self/cgroup");
    for (std::string line; std::getline(file, line);) {  // "0::/path", or "4:memory:/path" in version 1
        const std::size_t first = line.find(':');
        const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
        if (second == std::string::npos) {
            continue;
        }
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
        const fs::path group = line.substr(second + 1);
        if (controllers == ",,") {
            add_groups(root, version_2, group, groups);
        } else if (controllers.find(",memory,") != std::string::npos) {
            add_groups(root, version_1, group, groups);
        }
    }
    return groups;
}

std::uint64_t memory_of_process(const fs::path& root) {
    std::uint64_t bytes =
        static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    for (const MemoryGroup& group : memory_groups(root)) {
        bytes = std::min(bytes, group.limit);
    }
    return bytes;
}

}  // namespace diptych::core
