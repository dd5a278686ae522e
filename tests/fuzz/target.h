// What the fuzz targets share: a file for readers that take a path, and what counts as a refusal.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <span>
#include <string>
#include <unistd.h>

#include "error.h"

namespace diptych::core::fuzz {

/// A file of this process in a folder of its own, in memory where the machine has such a file system.
class InputFile {
public:
    explicit InputFile(const std::string& name) {
        const std::filesystem::path memory = "/dev/shm";
        const std::filesystem::path parent =
            std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
        folder_ = parent / ("diptych-fuzz-" + std::to_string(getpid()));
        std::filesystem::create_directory(folder_);
        path_ = folder_ / name;
    }
    ~InputFile() { std::filesystem::remove_all(folder_); }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::filesystem::path& write(std::span<const std::uint8_t> bytes) const {
        std::ofstream(path_, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        return path_;
    }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path folder_, path_;
};

/// Reads by `read`. The only exception that may leave it is an Error: one line that begins with the file's name. If a
/// message of the standard library follows the name, something was not checked.
template <typename Read>
void must_load_or_refuse(const std::filesystem::path& file, const Read& read) {
    try {
        read();
    } catch (const Error& error) {
        const std::string message = error.what();
        const std::string name = file.string() + ": ";
        const bool one_line = message.rfind(name, 0) == 0 && message.find('\n') == std::string::npos;
        if (!one_line || message.rfind(name + "vector::", 0) == 0 || message.rfind(name + "basic_string::", 0) == 0) {
            std::cerr << "not a refusal that a user can act on: " << message << '\n';
            std::abort();
        }
    }
}

/// Bytes that a fuzzed file may ask for: less than the fuzzer's own limit.
inline constexpr std::uint64_t memory_limit = std::uint64_t{64} << 20;

}  // namespace diptych::core::fuzz
