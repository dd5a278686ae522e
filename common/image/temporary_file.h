// A file under a temporary name beside its target, until it takes the target's place.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "image/byte_sink.h"

namespace diptych::core {

/// The file is called `.TARGET.PID-N.diptych-part` and holds a lock (flock) for as long as its writer lives. Where a
/// writer died, the kernel has released the lock: the first file that a later process writes into the folder removes
/// such leftovers. A lock tells this across containers and hosts, where a process id means nothing.
class TemporaryFile final : public ByteSink {
public:
    /// Throws Error where no file can be made in the target's folder. All errors name the target.
    explicit TemporaryFile(std::filesystem::path target);
    /// Removes the file, unless it was published.
    ~TemporaryFile() override;
    TemporaryFile(TemporaryFile&& other) noexcept;
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    TemporaryFile& operator=(TemporaryFile&&) = delete;

    /// Behind what was written so far.
    void write(std::string_view bytes);
    /// Several threads may write at once, at places of their own; `size` counts what is written when they are done.
    void write_at(std::uint64_t place, std::span<const unsigned char> bytes) override;
    std::uint64_t size() const;
    /// Waits until the disk holds what was written: many a write fails only then.
    void sync();
    /// Renames the file over its target and waits until the disk holds the new name.
    void publish();

private:
    std::filesystem::path target_;
    std::filesystem::path name_;  // empty once published
    int descriptor_ = -1;
    int direct_ = -1;  // past the page cache; -1 where the file system has no such thing
};

/// Throws the Error for a file that cannot be written.
[[noreturn]] void fail_to_write(const std::filesystem::path& path, const std::string& reason);

}  // namespace diptych::core
