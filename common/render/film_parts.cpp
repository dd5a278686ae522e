#include "render/film_parts.h"

#include <fmt/format.h>

#include "error.h"

namespace diptych::core {

void require_whole_samples(const std::string& part, const Metadata& metadata) {
    const auto uneven = metadata.find("uneven");
    if (uneven != metadata.end() && uneven->second == "yes") {
        throw Error(fmt::format("{}: was interrupted within a sample, which some pixels lack; go on from it with "
                                "`resume` first",
                                part));
    }
}

void require_same_picture(const std::string& part, const Metadata& metadata, const std::string& whole,
                          const Metadata& whole_metadata) {
    if (const std::string difference = picture_difference(whole_metadata, metadata); !difference.empty()) {
        throw Error(fmt::format("{}: is no part of the same picture as {}: {}", part, whole, difference));
    }
}

void require_other_samples(const FilmPart& part, const FilmPart& other) {
    if (const std::optional<SampleRange> shared = other.samples.shared_with(part.samples)) {
        throw Error(fmt::format("{}: has samples {} in common with {}", part.name, range_text(*shared), other.name));
    }
}

FilmFile read_part(const std::filesystem::path& path, std::uint64_t memory_limit) {
    std::optional<FilmFile> file = read_film(path, memory_limit);
    if (!file) {
        throw Error(fmt::format("{}: is a picture without the sums of its samples; render it with `samples` or `sums`",
                                path.string()));
    }
    require_whole_samples(path.string(), file->metadata);
    return std::move(*file);
}

SampleRanges missing_samples(const SampleRanges& samples) {
    SampleRanges missing = samples.gaps();
    if (!samples.empty()) {
        missing.add({0, samples.ranges().front().first});
    }
    return missing;
}

void count_anew(const Film& film, const SampleRanges& samples, Metadata& metadata) {
    const FilmTotals totals = film_totals(film);
    metadata.erase("command");
    metadata["spp"] = fmt::format("{}", samples.count());
    metadata["samples"] = samples.text();
    metadata["rays"] = fmt::format("{}", totals.rays);
    metadata["nonfinite"] = fmt::format("{}", totals.nonfinite);
    metadata["interrupted"] = "no";
    metadata["look_at"] = "";
}

}  // namespace diptych::core
