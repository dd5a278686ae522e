// The CPU panel's means against the oracle's, over the image and over its tiles.
#pragma once

#include "panels_fixture.h"

namespace diptych::core::tests {

/// One picture on both: 4 x 3 tiles of `tile` pixels a side.
inline constexpr int oracle_tile = 8;
inline constexpr int oracle_columns = 4;
inline constexpr int oracle_rows = 3;

/// Two-sided at 7e-6 for an image, and for the worst of its tiles and channels about 4e-5 in all.
inline constexpr double image_limit = 4.5;
inline constexpr double tile_limit = 5.5;

struct OraclePair {
    Film cpu;
    Film oracle;
};

/// `settings` of the size above; the oracle takes twice the samples and another seed.
OraclePair render_with_oracle(const Scene& scene, RenderSettings settings, std::uint32_t spp);

/// For render_with_oracle.
RenderSettings oracle_settings(std::uint32_t max_depth);

ImageMean tile_mean(const Film& film, int column, int row);

/// The relative bias that a test of this limit finds nine times in ten.
double detectable_bias(const ImageMean& a, const ImageMean& b, double limit);

}  // namespace diptych::core::tests
