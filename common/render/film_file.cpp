#include "render/film_file.h"

#include <fmt/format.h>

#include <set>
#include <stdexcept>

#include "error.h"
#include "image/image_file.h"
#include "image/layered_image.h"
#include "render/film_behind.h"
#include "render/film_words.h"

namespace diptych::core {

namespace {

std::string entry(const Metadata& metadata, const std::string& name) {
    const auto found = metadata.find(name);
    return found == metadata.end() ? "" : found->second;
}

/// Entries that say how a film came to be, or how it is shown. A scene is known by its fingerprint, not by its place.
const std::set<std::string>& idle_entries() {
    static const std::set<std::string> names = {"command", "scene",   "env",      "device",   "backend",     "spp",
                                                "samples", "seconds", "rays",     "nonfinite", "interrupted", "uneven", "uneven_from",
                                                "look_at",
                                                "exposure", "tonemap", "generic", "fingerprint"};
    return names;
}

/// A number of samples matters to the Hammersley set alone.
bool is_idle(const std::string& name, const Metadata& metadata) {
    return idle_entries().count(name) > 0 || (name == "sample_count" && entry(metadata, "sampler") != "hammersley");
}

}  // namespace

bool take_film_entries(Metadata& metadata) {
    const bool behind = metadata.erase(film_behind_entry) > 0;
    const bool in_channels = metadata.erase("sums_digest") > 0;  // by earlier versions
    return behind || in_channels;
}

std::optional<FilmFile> read_film(const std::filesystem::path& path, std::uint64_t memory_limit) {
    MemoryBudget budget(memory_limit);
    FilmFile file;
    file.metadata = read_metadata(path);
    const bool behind = file.metadata.count(film_behind_entry) > 0;
    take_film_entries(file.metadata);
    const std::optional<WordChannels> words = behind ? std::nullopt : read_words(path, budget);
    if (!behind && !words) {
        return std::nullopt;
    }
    try {
        file.samples = SampleRanges::parse(entry(file.metadata, "samples"));
        file.film = behind ? read_film_behind(path, budget)
                           : film_of_words(*words, entry(file.metadata, "standard_error") == "yes",
                                           entry(file.metadata, "first_hit_layers") == "yes", budget);
    } catch (const std::runtime_error& error) {
        throw Error(path.string() + ": cannot read its film: " + error.what());
    }
    return file;
}

std::string picture_difference(const Metadata& a, const Metadata& b) {
    // The oracle takes other samples than the panels.
    if ((entry(a, "backend") == "oracle") != (entry(b, "backend") == "oracle")) {
        return fmt::format("backend is {} and {}", entry(a, "backend"), entry(b, "backend"));
    }
    std::set<std::string> names;
    for (const Metadata* metadata : {&a, &b}) {
        for (const auto& [name, value] : *metadata) {
            names.insert(name);
        }
    }
    for (const std::string& name : names) {
        const std::string value_a = entry(a, name);
        const std::string value_b = entry(b, name);
        if (!is_idle(name, a) && value_a != value_b) {
            const auto shown = [](const std::string& value) { return value.empty() ? "not set" : value; };
            return fmt::format("{} is {} and {}", name, shown(value_a), shown(value_b));
        }
    }
    if (entry(a, "fingerprint") != entry(b, "fingerprint")) {
        return "the scene's content, its camera or its sky differs";
    }
    return "";
}

std::string picture_identity(const Metadata& metadata) {
    std::string identity = entry(metadata, "backend") == "oracle" ? "oracle" : "panel";
    for (const auto& [name, value] : metadata) {
        if (name == "fingerprint" || (!is_idle(name, metadata) && !value.empty())) {
            identity += "\n" + name + " " + value;
        }
    }
    return identity;
}

}  // namespace diptych::core
