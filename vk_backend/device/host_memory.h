// How much more memory this process may take from the machine.
#pragma once

#include <cstdint>

namespace diptych::core {

/// The least of what the machine has free, what the control group allows, and what the limits of the process leave
/// (RLIMIT_AS, RLIMIT_DATA). The largest number where none of these is known.
std::uint64_t host_bytes_left();

}  // namespace diptych::core
