#include "diptych/film.h"

#include <limits>

#include "image/tonemap_image.h"
#include "library/impl.h"
#include "render/film_statistics.h"

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

bool Film::has_sums() const {
    return !data_->film.pixels.empty();
}

namespace {

/// The pixels' sums, which a picture without them does not have.
const std::vector<core::shared::FilmPixel>& pixels_of(const FilmData& data) {
    if (data.film.pixels.empty()) {
        throw Error(data.name() + ": is a picture without the sums of its samples");
    }
    return data.film.pixels;
}

}  // namespace

std::vector<double> Film::sums() const {
    std::vector<double> sums;
    sums.reserve(3 * data_->film.pixels.size());
    for (const core::shared::FilmPixel& pixel : pixels_of(*data_)) {
        const core::Rgb sum = core::rounded(pixel.sum);
        sums.insert(sums.end(), sum.begin(), sum.end());
    }
    return sums;
}

std::vector<std::uint32_t> Film::sample_counts() const {
    std::vector<std::uint32_t> counts;
    counts.reserve(data_->film.pixels.size());
    for (const core::shared::FilmPixel& pixel : pixels_of(*data_)) {
        counts.push_back(pixel.samples);
    }
    return counts;
}

double Film::relmse_estimate() const {
    return core::estimated_relmse(data_->film).value_or(std::numeric_limits<double>::quiet_NaN());
}

std::vector<float> tone_mapped(const Film& film, double exposure) {
    return core::tonemapped(Impl::data(film).developed.color, core::default_tonemap, static_cast<float>(exposure)).data;
}

DIPTYCH_END
