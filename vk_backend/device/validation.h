// Messages of the validation layer, collected for the whole process.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vk {
struct DebugUtilsMessengerCreateInfoEXT;
}  // namespace vk

namespace diptych::core {

/// All warnings and errors so far; the first 100 with their text.
std::vector<std::string> validation_messages();
std::uint64_t validation_message_count();
void clear_validation_messages();

/// Whether validation is enabled: by `option` or by DIPTYCH_VALIDATION=1.
bool validation_wanted(bool option);

/// The callback that collects messages. It also prints the first 100 to stderr.
vk::DebugUtilsMessengerCreateInfoEXT validation_messenger();

}  // namespace diptych::core
