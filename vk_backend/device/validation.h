// What the validation layer said, over the whole process.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vk {
struct DebugUtilsMessengerCreateInfoEXT;
}  // namespace vk

namespace diptych::core {

/// Warnings and errors so far, the first 100 of them in full.
std::vector<std::string> validation_messages();
std::uint64_t validation_message_count();
void clear_validation_messages();

/// Whether validation is wanted: by option or by DIPTYCH_VALIDATION=1.
bool validation_wanted(bool option);

/// The callback that collects messages; each of the first 100 is printed to stderr too.
vk::DebugUtilsMessengerCreateInfoEXT validation_messenger();

}  // namespace diptych::core
