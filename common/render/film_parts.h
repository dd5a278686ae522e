// Renders of parts of one picture's samples, and what makes a whole of them.
#pragma once

#include <filesystem>
#include <string>

#include "render/film_file.h"

namespace diptych::core {

struct FilmPart {
    std::string name;  // a file, for messages
    SampleRanges samples;
};

/// Each throws Error, naming both parts and the reason, where they cannot be put together: the sums are of no whole
/// samples; the samples are of two pictures; both have the same samples.
void require_whole_samples(const std::string& part, const Metadata& metadata);
void require_same_picture(const std::string& part, const Metadata& metadata, const std::string& whole,
                          const Metadata& whole_metadata);
void require_other_samples(const FilmPart& part, const FilmPart& other);

/// The film of a file that may be a part. `memory_limit` is read_film's. Throws Error naming file and reason.
FilmFile read_part(const std::filesystem::path& path, std::uint64_t memory_limit = 0);

/// The samples up to the last one that are not there.
SampleRanges missing_samples(const SampleRanges& samples);

/// Of a film that parts were added to: the metadata that count its samples. The command that made one part is dropped.
void count_anew(const Film& film, const SampleRanges& samples, Metadata& metadata);

}  // namespace diptych::core
