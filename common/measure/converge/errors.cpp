#include "measure/converge/errors.h"

#include "image/metrics.h"
#include "render/film_statistics.h"

namespace diptych::core {

ErrorRow errors_of(const Film& film, const ReferencePicture& reference) {
    const Difference difference = compare_images(develop(film), reference.image);
    const FilmTotals totals = film_totals(film);
    ErrorRow row;
    row.mse = difference.mse;
    row.relmse = difference.relmse;
    row.relmse_trimmed = difference.relmse_trimmed;
    row.trimmed_energy = difference.trimmed_energy;
    row.nonfinite = totals.nonfinite;
    row.rays = totals.rays;
    return row;
}

std::vector<float> deviations_of(const Film& film, const ReferencePicture& reference) {
    const std::vector<float>& truth = reference.image.color.data;
    std::vector<float> deviations(truth.size());
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const Rgb mean = pixel_mean(film.pixels[i]);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            deviations[3 * i + channel] = static_cast<float>(mean[channel] - truth[3 * i + channel]);
        }
    }
    return deviations;
}

}  // namespace diptych::core
