#include "image/dead_parts.h"

#include <mutex>
#include <set>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace diptych::core {
namespace {

namespace fs = std::filesystem;

bool is_part(const fs::path& file) {
    const std::string name = file.filename().string();
    return name.front() == '.' && name.ends_with(part_ending);
}

/// Where the lock can be had, the writer is dead. On a file system without locks nothing is removed.
void remove_if_dead(const fs::path& part) {
    const int descriptor = ::open(part.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) {
        return;
    }
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
        ::unlink(part.c_str());
    }
    ::close(descriptor);
}

/// The first time that this process asks.
bool is_new(const fs::path& folder) {
    static std::mutex mutex;
    static std::set<fs::path> known;
    std::error_code failure;
    const fs::path whole = fs::canonical(folder, failure);
    const std::lock_guard lock(mutex);
    return !failure && known.insert(whole).second;
}

}  // namespace

void remove_dead_parts(const fs::path& folder) {
    if (!is_new(folder)) {
        return;
    }
    std::error_code failure;
    fs::directory_iterator entry(folder, failure);
    for (; !failure && entry != fs::directory_iterator(); entry.increment(failure)) {
        if (is_part(entry->path())) {
            remove_if_dead(entry->path());
        }
    }
}

}  // namespace diptych::core
