// Films in files, from which they come back to the bit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "render/film.h"
#include "render/sample_ranges.h"

namespace diptych::core {

using Metadata = std::map<std::string, std::string>;

struct FilmFile {
    Film film;
    Metadata metadata;     // as render_metadata gave it
    SampleRanges samples;  // that every pixel has
};

/// Reads what save_film has written with its sums. None where the file is a picture without them. The film may take
/// `memory_limit` bytes (memory_budget.h). Throws Error naming file and reason.
std::optional<FilmFile> read_film(const std::filesystem::path& path, std::uint64_t memory_limit = 0);

/// Takes out the entries of a file's metadata that tell where its film lies. They are of the file, not of the picture.
/// Returns whether the file has a film.
bool take_film_entries(Metadata& metadata);

/// The first setting that differs between two pictures' metadata so that their samples are not of one picture, as
/// "max_depth is 8 and 4"; empty where there is none. The machine, the limits and the display are no such settings, and
/// neither is the panel: both take the same samples.
std::string picture_difference(const Metadata& a, const Metadata& b);

/// All that picture_difference compares, as a text that is the same where there is no difference.
std::string picture_identity(const std::map<std::string, std::string>& metadata);

}  // namespace diptych::core
