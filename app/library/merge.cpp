// Films as one.
#include <fmt/format.h>

#include "diptych/film.h"
#include "library/impl.h"
#include "render/merge_films.h"

DIPTYCH_BEGIN

namespace {

/// Why two films of this process are not one picture's; empty where they are.
std::string mismatch(const FilmData& a, const FilmData& b) {
    if (a.film.width != b.film.width || a.film.height != b.film.height) {
        return fmt::format("{}x{} and {}x{} pixels", a.film.width, a.film.height, b.film.width, b.film.height);
    }
    if (a.info.scene != b.info.scene || a.origin->revision != b.origin->revision) {
        return "they show different scenes, or a scene before and after an edit";
    }
    if (core::change_between(a.origin->moment, {}, b.origin->moment, {}) != core::Change::nothing) {
        return "they show different moments or views";
    }
    Settings settings = b.info.settings;
    settings.seed = a.info.settings.seed;
    if (settings != a.info.settings) {
        return "their settings differ in more than the seed";
    }
    if (a.film.moments.empty() != b.film.moments.empty() || a.film.first_hits.empty() != b.film.first_hits.empty()) {
        return "one has layers that the other lacks";
    }
    return "";
}

/// Metadata to compare: films of several seeds add up too.
core::Metadata but_for_the_seed(core::Metadata metadata) {
    metadata.erase("seed");
    return metadata;
}

void require_one_picture(const FilmData& part, const FilmData& whole) {
    if (whole.origin && part.origin) {
        if (const std::string reason = mismatch(whole, part); !reason.empty()) {
            throw Error("film: cannot merge: " + reason);
        }
    } else {
        core::require_same_picture(part.name(), but_for_the_seed(part.metadata), whole.name(),
                                   but_for_the_seed(whole.metadata));
    }
}

void require_new_samples(const FilmData& part, const FilmData& whole) {
    for (const FilmSamples& a : part.samples) {
        for (const FilmSamples& b : whole.samples) {
            if (a.seed != b.seed) {
                continue;
            }
            const bool both_rendered = part.origin && whole.origin;
            if (part.chained() && !both_rendered) {  // of which files tell no ranges
                throw Error(fmt::format("{}: its samples go on from one another, and {} has some of the same seed {}",
                                        a.part.name, b.part.name, a.seed));
            }
            const std::string other = both_rendered ? "the film it is merged into" : b.part.name;
            core::require_other_samples(a.part, {other, b.part.samples});
        }
    }
}

}  // namespace

void require_sums(const FilmData& data) {
    if (data.film.pixels.empty()) {
        throw Error(data.name() +
                    ": is a picture without the sums of its samples, and cannot be merged or gone on from");
    }
    core::require_whole_samples(data.name(), data.metadata);
}

void Film::merge(const Film& other) {
    guarded([&] {
        require_sums(*data_);
        require_sums(*other.data_);
        require_one_picture(*other.data_, *data_);
        require_new_samples(*other.data_, *data_);
        auto merged = std::make_shared<FilmData>(*data_);
        core::merge_films(other.data_->film, merged->film);
        merged->samples.insert(merged->samples.end(), other.data_->samples.begin(), other.data_->samples.end());
        FilmInfo& info = merged->info;
        info.spp += other.info().spp;
        info.samples += other.info().samples;
        info.nonfinite += other.info().nonfinite;
        info.rays += other.info().rays;
        info.seconds += other.info().seconds;
        merged->developed = core::develop(merged->film);
        data_ = std::move(merged);
    });
}

Film merge(const std::vector<Film>& parts, const MergeOptions& options) {
    return guarded([&] {
        if (parts.empty()) {
            throw Error("merge: there are no films");
        }
        Film whole = parts.front();
        for (std::size_t i = 1; i < parts.size(); ++i) {
            whole.merge(parts[i]);
        }
        std::map<std::uint32_t, core::SampleRanges> of_seed;
        for (const FilmSamples& samples : Impl::data(whole).samples) {
            of_seed[samples.seed].add(samples.part.samples);
        }
        for (const auto& [seed, samples] : of_seed) {
            const core::SampleRanges missing = core::missing_samples(samples);
            if (!missing.empty() && !options.partial) {
                throw Error(fmt::format("merge: no film has samples {} of seed {}; `partial` merges what is there",
                                        missing.text(), seed));
            }
        }
        return whole;
    });
}

DIPTYCH_END
