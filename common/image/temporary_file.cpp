#include "image/temporary_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "error.h"
#include "image/dead_parts.h"

namespace diptych::core {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_write = std::size_t{32} << 20U;
constexpr std::size_t longest_stem = 180;  // leaves room for the rest of the name, within the 255 bytes of most disks

fs::path folder_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// The reason of a failure with this errno, in words that help.
std::string reason_of(int code, const fs::path& target) {
    std::error_code ignored;
    const fs::path folder = folder_of(target);
    if (code == ENOENT && !fs::exists(folder, ignored)) {
        return "the folder '" + folder.string() + "' does not exist";
    }
    const std::string text = std::strerror(code);
    return code == EFBIG ? text + " (a limit of the file system or of the process)" : text;
}

/// The page cache costs a copy, and on a machine that is short of memory much more, before the disk begins. A render has
/// no use for what it has written.
bool goes_past_cache(std::uint64_t place, std::span<const unsigned char> bytes) {
    constexpr std::size_t least = std::size_t{1} << 20U;
    return bytes.size() >= least && bytes.size() % sink_page == 0 && place % sink_page == 0 &&
           reinterpret_cast<std::uintptr_t>(bytes.data()) % sink_page == 0;
}

/// Some file systems have no fsync; there nothing is left to wait for.
bool failed_to_sync(int descriptor) {
    return ::fsync(descriptor) != 0 && errno != EINVAL && errno != ENOSYS && errno != ENOTSUP;
}

/// False where the file is gone, because another process swept the folder between its making and its lock.
bool lock_new_file(int descriptor) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        return false;
    }
    struct stat status = {};
    return ::fstat(descriptor, &status) == 0 && status.st_nlink > 0;
}

}  // namespace

void fail_to_write(const fs::path& path, const std::string& reason) {
    throw Error(path.string() + ": cannot write: " + reason);
}

TemporaryFile::TemporaryFile(fs::path target) : target_(std::move(target)) {
    static std::atomic<unsigned> counter{0};
    const fs::path folder = folder_of(target_);
    remove_dead_parts(folder);
    while (descriptor_ < 0) {
        name_ = folder / ("." + target_.filename().string().substr(0, longest_stem) + "." + std::to_string(getpid()) +
                          "-" + std::to_string(counter++) + part_ending);
        descriptor_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ < 0 && errno != EEXIST) {
            fail_to_write(target_, reason_of(errno, target_));
        }
        if (descriptor_ >= 0 && !lock_new_file(descriptor_)) {
            ::close(descriptor_);
            descriptor_ = -1;
        }
    }
    direct_ = ::open(name_.c_str(), O_WRONLY | O_DIRECT | O_CLOEXEC);
}

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept
    : target_(std::move(other.target_)),
      name_(std::exchange(other.name_, fs::path())),
      descriptor_(std::exchange(other.descriptor_, -1)),
      direct_(std::exchange(other.direct_, -1)) {}

TemporaryFile::~TemporaryFile() {
    if (!name_.empty()) {
        ::unlink(name_.c_str());
    }
    for (const int open : {descriptor_, direct_}) {
        if (open >= 0) {
            ::close(open);
        }
    }
}

void TemporaryFile::write(std::string_view bytes) {
    write_at(size(), {reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
}

void TemporaryFile::write_at(std::uint64_t place, std::span<const unsigned char> bytes) {
    while (!bytes.empty()) {
        const auto at = static_cast<off_t>(place);
        const std::size_t count = std::min(bytes.size(), longest_write);
        ssize_t written = direct_ >= 0 && goes_past_cache(place, bytes.first(count))
                              ? ::pwrite(direct_, bytes.data(), count, at)
                              : -2;
        if (written == -2 || (written < 0 && errno == EINVAL)) {  // or where pages are larger there
            written = ::pwrite(descriptor_, bytes.data(), count, at);
        }
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written <= 0) {
            fail_to_write(target_, written < 0 ? reason_of(errno, target_) : "nothing could be written");
        }
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        place += static_cast<std::uint64_t>(written);
        // The disk begins while the rest is made, so that `sync` waits less. No matter where the system cannot.
        ::sync_file_range(descriptor_, at, written, SYNC_FILE_RANGE_WRITE);
    }
}

std::uint64_t TemporaryFile::size() const {
    struct stat status = {};
    if (::fstat(descriptor_, &status) != 0) {
        fail_to_write(target_, reason_of(errno, target_));
    }
    return static_cast<std::uint64_t>(status.st_size);
}

void TemporaryFile::sync() {
    if (failed_to_sync(descriptor_)) {
        fail_to_write(target_, reason_of(errno, target_));
    }
}

void TemporaryFile::publish() {
    if (::rename(name_.c_str(), target_.c_str()) != 0) {
        fail_to_write(target_, reason_of(errno, target_));
    }
    name_.clear();
    const int folder = ::open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool failed = folder >= 0 && failed_to_sync(folder);  // a folder that cannot be read cannot be synced
    const int reason = errno;
    if (folder >= 0) {
        ::close(folder);
    }
    if (failed) {
        fail_to_write(target_, reason_of(reason, target_));
    }
}

}  // namespace diptych::core
