// Reading files, for every reader of the program: what is no regular file is refused before it is read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "memory_budget.h"

namespace diptych::core {

/// Why nothing is read from the path: it is missing, a folder, or a device, a pipe or a socket, which may never end.
/// Empty where it is a file; does not block.
std::string input_problem(const std::filesystem::path& path);

/// Throws Error "path: reason" where there is such a problem.
void require_input(const std::filesystem::path& path);

/// The whole file. Throws Error, its message without the file's name, where input_problem has a reason, where the file
/// cannot be read, and OverBudget where it is larger than the budget.
std::vector<std::uint8_t> read_file(const std::filesystem::path& path, MemoryBudget& budget);

}  // namespace diptych::core
