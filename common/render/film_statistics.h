// What one pixel's sums say: its mean, and how well that mean is known.
#pragma once

#include <array>
#include <optional>

#include "render/film.h"

namespace diptych::core {

using Rgb = std::array<double, 3>;

/// The sums rounded to double.
Rgb rounded(const shared::ExactSum& sum);
Rgb rounded(const shared::FixedSum& sum);
double rounded(const shared::ExactScalar& sum);

/// Mean radiance; black where the pixel has no samples.
Rgb pixel_mean(const shared::FilmPixel& pixel);

/// Means of the first hit over all samples, dropped ones included.
struct MeanFirstHit {
    Rgb albedo{};
    Rgb normal{};
    double depth = 0;
};

MeanFirstHit mean_first_hit(const shared::FilmPixel& pixel, const shared::FilmFirstHit& hit);

/// Standard error of the mean radiance, sqrt(s^2 / n) with the unbiased sample variance; NaN below two samples. It treats the
/// samples as independent, so it overstates the error of a stratified sampler.
Rgb pixel_standard_error(const shared::FilmPixel& pixel, const shared::FilmMoments& moments);

/// The relMSE that the film would show against the truth, mean of se^2 / (mean^2 + 1e-2) over the pixels and channels
/// whose standard error is known; none where no moments are kept or no pixel has two samples.
std::optional<double> estimated_relmse(const Film& film);

}  // namespace diptych::core
