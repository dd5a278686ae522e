// Text of a file inside a message.
#pragma once

#include <string>

namespace diptych::core {

/// Control characters, line ends among them, as spaces, and none at the end: names in files may hold any, and a
/// terminal would obey them.
std::string one_line(std::string text);

}  // namespace diptych::core
