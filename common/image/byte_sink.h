// Where an encoder puts the bytes of a file.
#pragma once

#include <cstdint>
#include <span>

namespace diptych::core {

class ByteSink {
public:
    virtual ~ByteSink() = default;
    /// Formats with tables write those last, before what they have written already. Throws Error.
    virtual void write_at(std::uint64_t place, std::span<const unsigned char> bytes) = 0;
};

}  // namespace diptych::core
