#include "device/host_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "memory_groups.h"

namespace diptych::core {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t less(std::uint64_t limit, std::uint64_t used) {
    return limit > used ? limit - used : 0;
}

/// What a limit of the process leaves.
std::uint64_t left_of(__rlimit_resource_t resource, std::uint64_t used) {
    rlimit limit = {};
    return getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ? unlimited : less(limit.rlim_cur, used);
}

/// MemAvailable of /proc/meminfo.
std::uint64_t available() {
    std::ifstream file("/proc/meminfo");
    std::string name, unit;
    for (std::uint64_t kilobytes = 0; file >> name >> kilobytes && std::getline(file, unit);) {
        if (name == "MemAvailable:") {
            return kilobytes * 1024;
        }
    }
    return unlimited;
}

/// What the control groups of this process leave.
std::uint64_t left_of_groups() {
    std::uint64_t left = unlimited;
    for (const MemoryGroup& group : memory_groups()) {
        left = std::min(left, less(group.limit, group.used));
    }
    return left;
}

}  // namespace

std::uint64_t host_bytes_left() {
    // Pages: total program size, resident, shared, text, unused, data and stack.
    std::uint64_t size = 0, resident = 0, shared = 0, text = 0, unused = 0, data = 0;
    std::ifstream("/proc/self/statm") >> size >> resident >> shared >> text >> unused >> data;
    const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    return std::min({available(), left_of_groups(), left_of(RLIMIT_AS, size * page), left_of(RLIMIT_DATA, data * page)});
}

}  // namespace diptych::core
