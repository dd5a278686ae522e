#pragma once

#include <stdexcept>
#include <string>

namespace diptych::core {

/// OpenImageIO's message may have several lines, or none.
[[noreturn]] inline void fail_by_library(const std::string& message) {
    const std::string line = message.substr(0, message.find('\n'));
    throw std::runtime_error(line.empty() ? "unknown reason" : line);
}

}  // namespace diptych::core
