// How much memory a file may make the program allocate.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "error.h"

namespace diptych::core {

/// A file asks for more than `memory_limit`; `what()` says how much and what the limit is.
class OverBudget : public Error {
public:
    using Error::Error;
};

/// A quarter of the machine's memory, or of what the process's control groups let it have of it, in bytes.
std::uint64_t default_memory_limit();

/// Bytes as "4.0 GB".
std::string memory_text(std::uint64_t bytes);

/// "500M", "2G" or a number of bytes; K, M, G and T are powers of 1024. Throws Error without the setting's name.
std::uint64_t memory_from_text(const std::string& text);

/// Counts what one file and what it names ask for, before any of it is allocated. Several threads may ask at once.
class MemoryBudget {
public:
    /// 0 is the default limit.
    explicit MemoryBudget(std::uint64_t limit) : limit_(limit > 0 ? limit : default_memory_limit()) {}

    /// Throws OverBudget, without a file's name, where all that was asked for is more than the limit.
    void ask(std::uint64_t bytes);

private:
    const std::uint64_t limit_;
    std::atomic<std::uint64_t> asked_{0};
};

/// The bytes of `count` elements of so many bytes each; the largest number where that is out of range.
std::uint64_t bytes_of(std::uint64_t count, std::uint64_t each);

}  // namespace diptych::core
