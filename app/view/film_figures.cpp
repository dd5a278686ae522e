#include "view/film_figures.h"

#include <cmath>

namespace diptych::core::app {

FilmFigures film_figures(const Film& film, std::uint64_t version, std::uint32_t spp) {
    FilmFigures figures;
    figures.version = version;
    figures.spp = spp;
    figures.width = film.width;
    figures.height = film.height;
    const double pixels = static_cast<double>(film.pixels.size());
    Rgb variance{};
    bool known = !film.moments.empty();
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const Rgb mean = pixel_mean(film.pixels[i]);
        Rgb error{};
        if (known) {
            error = pixel_standard_error(film.pixels[i], film.moments[i]);
            known = film.pixels[i].samples > 1;
        }
        for (std::size_t channel = 0; channel < mean.size(); ++channel) {
            figures.mean[channel] += mean[channel] / pixels;
            variance[channel] += error[channel] * error[channel] / (pixels * pixels);
        }
    }
    if (known) {
        figures.standard_error = Rgb{std::sqrt(variance[0]), std::sqrt(variance[1]), std::sqrt(variance[2])};
        figures.relmse = estimated_relmse(film);
    }
    const FilmTotals totals = film_totals(film);
    figures.nonfinite = totals.nonfinite;
    figures.rays = totals.rays;
    return figures;
}

}  // namespace diptych::core::app
