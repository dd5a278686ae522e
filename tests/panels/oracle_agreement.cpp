// The CPU panel against the oracle, which shares no code with it: Welch's test of the image mean and of every tile. The
// samples of a side are independent, so a mean's error is theirs, and its degrees of freedom are so many that t is
// normal.
#include <algorithm>
#include <cstdio>

#include "oracle_means.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

struct Agreement {
    double image_z = 0;
    double tile_z = 0;            // of the worst tile
    double detectable_image = 0;  // relative bias of the mean that is found nine times in ten
    double detectable_tile = 0;   // median over the tiles
};

Agreement compare(const OraclePair& pair) {
    Agreement out;
    const ImageMean a = image_mean(pair.cpu);
    const ImageMean b = image_mean(pair.oracle);
    out.image_z = worst_z(a, b);
    out.detectable_image = detectable_bias(a, b, image_limit);
    std::vector<double> detectable;
    for (int row = 0; row < oracle_rows; ++row) {
        for (int column = 0; column < oracle_columns; ++column) {
            const ImageMean c = tile_mean(pair.cpu, column, row);
            const ImageMean o = tile_mean(pair.oracle, column, row);
            out.tile_z = std::max(out.tile_z, worst_z(c, o));
            detectable.push_back(detectable_bias(c, o, tile_limit));
        }
    }
    std::sort(detectable.begin(), detectable.end());
    out.detectable_tile = detectable[detectable.size() / 2];
    return out;
}

/// `detectable`: the bias of the image mean that the test has to be able to find.
void check_against_oracle(const std::string& name, const Scene& scene, double detectable) {
    const OraclePair pair = render_with_oracle(scene, oracle_settings(4), 512);
    const Agreement a = compare(pair);
    std::printf("%-30s z %.2f, worst tile %.2f; would find a bias of %.2f %% of the image, %.1f %% of a tile\n",
                name.c_str(), a.image_z, a.tile_z, 100 * a.detectable_image, 100 * a.detectable_tile);
    INFO(name << ": cpu " << describe(image_mean(pair.cpu)) << "oracle " << describe(image_mean(pair.oracle)) << "z "
              << a.image_z << " tile " << a.tile_z);
    CHECK(a.image_z < image_limit);
    CHECK(a.tile_z < tile_limit);
    CHECK(a.detectable_image < detectable);
}

}  // namespace

TEST_CASE("The CPU panel has the oracle's means") {
    check_against_oracle("cornell", load_own_scene("cornell"), 0.06);
    for (const auto& [name, scene] : agreement_scenes()) {
        if (name == "unlit screen and a spot light" || name == "mirrored instances of a light" ||
            name == "normal-mapped gloss") {
            check_against_oracle(name, scene, 0.06);
        }
    }
}
