// Numbers in a binary file with a checksum, so that damage is found and not averaged in.
#pragma once

#include <cstring>
#include <optional>
#include <string>
#include <vector>

namespace diptych::core {

/// Writes the bytes and their checksum. Throws Error.
void write_checked_file(const std::string& path, std::string bytes);

/// The bytes; nothing where there is no such file. Throws an Error that names the file where it is not as it was written.
std::optional<std::string> read_checked_file(const std::string& path);

/// Takes values off the bytes of a file, one after the other.
class ByteReader {
public:
    explicit ByteReader(const std::string& bytes) : bytes_(bytes) {}

    template <class T>
    bool take(T& value) {
        return copy(&value, sizeof value);
    }
    template <class T>
    bool take(std::vector<T>& values, std::size_t count) {
        if (count > left() / sizeof(T)) {
            return false;
        }
        values.resize(count);
        return copy(values.data(), count * sizeof(T));
    }
    std::size_t left() const { return bytes_.size() - at_; }

private:
    bool copy(void* to, std::size_t size) {
        if (size > left()) {
            return false;
        }
        if (size > 0) {
            std::memcpy(to, bytes_.data() + at_, size);
        }
        at_ += size;
        return true;
    }

    const std::string& bytes_;
    std::size_t at_ = 0;
};

/// Throws the Error for a file whose content is not what it should be.
[[noreturn]] void fail_as_damaged(const std::string& path);

}  // namespace diptych::core
