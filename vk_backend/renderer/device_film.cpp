#include "renderer/device_film.h"

#include <algorithm>

#include "commands/commands.h"
#include "language/scene_features.h"

namespace diptych::core {
namespace {

std::uint32_t layers_of(const Film& film) {
    return (film.moments.empty() ? 0U : shared::FEATURE_STANDARD_ERROR) |
           (film.first_hits.empty() ? 0U : shared::FEATURE_FIRST_HIT_LAYERS);
}

}  // namespace

DeviceFilm FilmUploader::upload(const Film& film) {
    return in_context("copying a picture to the device", [&] {
        if (!film_ || !fits(*film_, film.width, film.height, layers_of(film))) {
            film_ = std::make_shared<FilmMemory>(make_film(*gpu_, film.width, film.height, layers_of(film)));
        }
        if (!uploader_) {
            uploader_ = std::make_unique<Uploader>(
                *gpu_, std::clamp<std::uint64_t>(film_bytes(*film_), 4096, std::uint64_t{64} << 20U));
        }
        const auto upload = [&](const Buffer& buffer, const std::vector<std::uint32_t>& words) {
            uploader_->upload(buffer, std::as_bytes(std::span(words)));
        };
        upload(film_->pixels, device_words(film.pixels));
        upload(film_->moments, device_words(film.moments));
        upload(film_->first_hits, device_words(film.first_hits));
        uploader_->finish();
        return DeviceFilm{.gpu = gpu_, .film = film_, .resampling = {}, .reservoir_set = 0};
    });
}

}  // namespace diptych::core
