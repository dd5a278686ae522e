#include "diptych/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "image/image_file.h"
#include "image/tonemap_image.h"
#include "library/impl.h"
#include "render/film_statistics.h"
#include "render/merge_films.h"
#include "render/save_film.h"

DIPTYCH_BEGIN

Film::Film(std::shared_ptr<const FilmData> data) : data_(std::move(data)) {}

int Film::width() const {
    return data_->film.width;
}

int Film::height() const {
    return data_->film.height;
}

const FilmInfo& Film::info() const {
    return data_->info;
}

std::span<const float> Film::radiance() const {
    return data_->developed.color.data;
}

namespace {

std::span<const float> values(const std::optional<core::Image>& image) {
    return image ? std::span<const float>(image->data) : std::span<const float>();
}

}  // namespace

std::span<const float> Film::standard_error() const {
    return values(data_->developed.standard_error);
}

std::span<const float> Film::layer(const std::string& name) const {
    if (name == "radiance") {
        return radiance();
    }
    if (name == "standard_error") {
        return standard_error();
    }
    if (name == "albedo") {
        return values(data_->developed.albedo);
    }
    if (name == "normal") {
        return values(data_->developed.normal);
    }
    if (name == "depth") {
        return values(data_->developed.depth);
    }
    throw Error("film: no layer '" + name + "'; there are radiance, standard_error, albedo, normal and depth");
}

std::vector<double> Film::sums() const {
    std::vector<double> sums;
    sums.reserve(3 * data_->film.pixels.size());
    for (const core::shared::FilmPixel& pixel : data_->film.pixels) {
        const core::Rgb sum = core::rounded(pixel.sum);
        sums.insert(sums.end(), sum.begin(), sum.end());
    }
    return sums;
}

std::vector<std::uint32_t> Film::sample_counts() const {
    std::vector<std::uint32_t> counts;
    counts.reserve(data_->film.pixels.size());
    for (const core::shared::FilmPixel& pixel : data_->film.pixels) {
        counts.push_back(pixel.samples);
    }
    return counts;
}

double Film::relmse_estimate() const {
    return core::estimated_relmse(data_->film).value_or(std::numeric_limits<double>::quiet_NaN());
}

namespace {

bool share_samples(const SampleRange& a, const SampleRange& b) {
    return a.seed == b.seed && a.first < b.first + b.count && b.first < a.first + a.count;
}

/// Why two films are not one picture's; empty where they are.
std::string mismatch(const FilmData& a, const FilmData& b) {
    if (a.film.width != b.film.width || a.film.height != b.film.height) {
        return fmt::format("{}x{} and {}x{} pixels", a.film.width, a.film.height, b.film.width, b.film.height);
    }
    if (a.info.scene != b.info.scene || a.revision != b.revision) {
        return "they show different scenes, or a scene before and after an edit";
    }
    if (core::change_between(a.moment, {}, b.moment, {}) != core::Change::nothing) {
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
    for (const SampleRange& range : a.ranges) {
        for (const SampleRange& other : b.ranges) {
            if (share_samples(range, other)) {
                return fmt::format("both have samples {} to {} of seed {}", std::max(range.first, other.first),
                                   std::min(range.first + range.count, other.first + other.count) - 1, range.seed);
            }
        }
    }
    return "";
}

}  // namespace

void Film::merge(const Film& other) {
    if (const std::string reason = mismatch(*data_, *other.data_); !reason.empty()) {
        throw Error("film: cannot merge: " + reason);
    }
    auto merged = std::make_shared<FilmData>(*data_);
    core::merge_films(other.data_->film, merged->film);
    merged->ranges.insert(merged->ranges.end(), other.data_->ranges.begin(), other.data_->ranges.end());
    FilmInfo& info = merged->info;
    info.spp += other.info().spp;
    info.samples += other.info().samples;
    info.nonfinite += other.info().nonfinite;
    info.rays += other.info().rays;
    info.seconds += other.info().seconds;
    merged->developed = core::develop(merged->film);
    data_ = std::move(merged);
}

void Film::save(const std::string& path) const {
    guarded([&] {
        core::check_writable(path);
        core::RenderRequest request = data_->request;
        request.output = path;
        core::RenderOutcome outcome;
        outcome.maker.program = "diptych " DIPTYCH_VERSION;
        outcome.device = data_->info.device;
        outcome.spp = data_->info.spp;
        outcome.seconds = data_->info.seconds;
        outcome.rays = data_->info.rays;
        outcome.nonfinite = data_->info.nonfinite;
        core::save_film(data_->film, request, outcome);
    });
}

std::vector<float> tone_mapped(const Film& film, double exposure) {
    return core::tonemapped(Impl::data(film).developed.color, core::default_tonemap, static_cast<float>(exposure)).data;
}

DIPTYCH_END
