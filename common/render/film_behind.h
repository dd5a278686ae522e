// A film behind the picture in an EXR file, where readers of pictures do not look: they find all rows by a table at the
// file's beginning. The film's sums are what is gone on from and merged; the picture can be made from them.
//
// After the picture come groups of pixels (film_blocks.h), each at a multiple of 4096 bytes, a table with size and digest
// of each group, and a footer of fixed size, with which a reader begins. All numbers are little-endian.
#pragma once

#include <filesystem>

#include "image/temporary_file.h"
#include "memory_budget.h"
#include "render/film.h"

namespace diptych::core {

/// The metadata of a file with such a film have this entry.
inline constexpr const char* film_behind_entry = "sums_place";

/// Appends the film to the file. Packs and writes on all cores. Throws Error.
void write_film_behind(const Film& film, TemporaryFile& file);

/// Asks the budget for the film before it is allocated. Throws std::runtime_error where there is no such film, where it
/// is damaged, or where it is too large.
Film read_film_behind(const std::filesystem::path& path, MemoryBudget& budget);

}  // namespace diptych::core
