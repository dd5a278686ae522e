// A file under a temporary name beside its target, until it takes the target's place.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace diptych::core {

/// The file is called `.TARGET.PID-N.diptych-part` and holds a lock (flock) for as long as its writer lives. Where a
/// writer died, the kernel has released the lock: the first file that a later process writes into the folder removes
/// such leftovers. A lock tells this across containers and hosts, where a process id means nothing.
class TemporaryFile {
public:
    /// Throws Error where no file can be made in the target's folder. All errors name the target.
    explicit TemporaryFile(std::filesystem::path target);
    /// Removes the file, unless it was published.
    ~TemporaryFile();
    TemporaryFile(TemporaryFile&& other) noexcept;
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    TemporaryFile& operator=(TemporaryFile&&) = delete;

    void write(std::string_view bytes);
    /// Waits until the disk holds what was written: many a write fails only then.
    void sync();
    /// Renames the file over its target and waits until the disk holds the new name.
    void publish();

private:
    std::filesystem::path target_;
    std::filesystem::path name_;  // empty once published
    int descriptor_ = -1;
};

/// Throws the Error for a file that cannot be written.
[[noreturn]] void fail_to_write(const std::filesystem::path& path, const std::string& reason);

}  // namespace diptych::core
