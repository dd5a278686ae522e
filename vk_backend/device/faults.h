// Failures that tests cause on a device. The program sets none.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "device/memory_use.h"

namespace diptych::core {

/// May be called from any thread that uses the device.
struct Faults {
    /// Whether this allocation fails as if the memory had run out.
    std::function<bool(Purpose purpose, std::uint64_t bytes)> allocation;
    /// Whether the device is lost at this submission.
    std::function<bool()> submission;
    /// Bytes that the device seems to have for all purposes together.
    std::uint64_t memory = std::numeric_limits<std::uint64_t>::max();
};

}  // namespace diptych::core
