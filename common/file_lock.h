// A file that one process at a time may hold.
#pragma once

#include <filesystem>

namespace diptych::core {

/// An exclusive lock (flock) on a file, which is made where it is missing and stays. The kernel releases the lock when
/// the process ends, however it ends. On a file system without locks every process gets it.
class FileLock {
public:
    explicit FileLock(const std::filesystem::path& file);
    ~FileLock();
    FileLock(FileLock&& other) noexcept;
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;
    FileLock& operator=(FileLock&&) = delete;

    /// False where another process holds the lock.
    bool held() const { return descriptor_ >= 0; }

private:
    int descriptor_ = -1;
};

}  // namespace diptych::core
