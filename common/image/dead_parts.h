// What writers that died left behind: temporary files (temporary_file.h).
#pragma once

#include <filesystem>

namespace diptych::core {

inline constexpr const char* part_ending = ".diptych-part";

/// Removes the temporary files in the folder whose writers are dead; once a folder in this process. Never throws.
void remove_dead_parts(const std::filesystem::path& folder);

}  // namespace diptych::core
