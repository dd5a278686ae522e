#include "window/picture_saver.h"

#include <fmt/format.h>

#include <chrono>

#include "render/save_film.h"

namespace diptych::core::app {

std::filesystem::path next_picture(const std::filesystem::path& folder, const std::string& scene,
                                   const std::string& extension) {
    const std::string stem = std::filesystem::path(scene).stem().string();
    for (int number = 1;; ++number) {
        const std::string base = (folder / fmt::format("{}-view-{:03}", stem, number)).string();
        if (!std::filesystem::exists(base + ".png") && !std::filesystem::exists(base + ".exr")) {
            return base + extension;
        }
    }
}

void FilmSaver::await(std::future<KeptFilm> film, std::filesystem::path path) {
    film_ = std::move(film);
    path_ = std::move(path);
}

std::optional<std::filesystem::path> FilmSaver::save() {
    if (!film_.valid() || film_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        return std::nullopt;
    }
    KeptFilm kept = film_.get();
    kept.request.output = path_.string();
    save_film(kept.film, kept.request, kept.outcome);
    return path_;
}

}  // namespace diptych::core::app
