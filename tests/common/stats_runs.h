// Runs of made-up renders, of many kinds of noise.
#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "stats/bias_test.h"

namespace diptych::core::tests {

inline constexpr int runs_a_side = 32;

/// One tile's mean in one run.
using TileNoise = std::function<Channels(std::mt19937_64&)>;

/// Of mean (1, 1, 1), channels correlated, standard deviations of 10, 9.4 and 7.1 %.
inline TileNoise normal_noise() {
    return [](std::mt19937_64& random) {
        std::normal_distribution<double> normal;
        const double x = normal(random);
        const double y = normal(random);
        const double z = normal(random);
        return Channels{1 + 0.1 * x, 1 + 0.08 * x + 0.05 * y, 1 + 0.05 * x + 0.05 * z};
    };
}

/// The mean of `samples` lognormal samples of that coefficient of variation, and a little else in the other channels.
inline TileNoise lognormal_noise(double cv, int samples) {
    return [=](std::mt19937_64& random) {
        const double sigma = std::sqrt(std::log(1 + cv * cv));
        std::normal_distribution<double> normal;
        double x = 0;
        for (int i = 0; i < samples; ++i) {
            x += std::exp(sigma * normal(random) - sigma * sigma / 2) / samples;
        }
        const double y = normal(random) / std::sqrt(samples);
        const double z = normal(random) / std::sqrt(samples);
        return Channels{x, 0.8 * x + 0.05 * y + 0.2, 0.5 * x + 0.05 * z + 0.1};
    };
}

/// Smooth light and rare events of equal size, so many a run on average: what a small lamp gives that only chance hits.
/// Mean (2, 1.7, 0.8).
inline TileNoise spike_noise(double events) {
    return [=](std::mt19937_64& random) {
        std::poisson_distribution<int> poisson(events);
        std::normal_distribution<double> normal;
        const double hits = poisson(random) / events;
        const double y = 0.01 * normal(random);
        const double z = 0.01 * normal(random);
        return Channels{hits + 1 + y, 0.7 * hits + 1 + y + 0.5 * z, 0.3 * hits + 0.5 + z};
    };
}

inline TileNoise grey(const TileNoise& noise) {
    return [noise](std::mt19937_64& random) {
        const double value = noise(random)[0];
        return Channels{value, value, value};
    };
}

/// So many runs of so many tiles, each with the noise that is given for it.
inline std::vector<RunMeans> made_up_runs(std::mt19937_64& random, int runs, int tiles,
                                          const std::function<TileNoise(int tile)>& noise_of) {
    std::vector<RunMeans> result(static_cast<std::size_t>(runs));
    for (RunMeans& run : result) {
        for (int tile = 0; tile < tiles; ++tile) {
            run.tiles.push_back(noise_of(tile)(random));
            for (std::size_t c = 0; c < 3; ++c) {
                run.image[c] += run.tiles.back()[c] / tiles;
            }
        }
    }
    return result;
}

inline std::vector<RunMeans> made_up_runs(std::mt19937_64& random, int runs, int tiles, const TileNoise& noise) {
    return made_up_runs(random, runs, tiles, [&](int) { return noise; });
}

/// By that much, in all channels.
inline TileNoise shifted(const TileNoise& noise, double shift) {
    return [=](std::mt19937_64& random) {
        const Channels value = noise(random);
        return Channels{value[0] + shift, value[1] + shift, value[2] + shift};
    };
}

/// By that factor.
inline TileNoise scaled(const TileNoise& noise, double factor) {
    return [=](std::mt19937_64& random) {
        Channels value = noise(random);
        for (double& channel : value) {
            channel *= factor;
        }
        return value;
    };
}

}  // namespace diptych::core::tests
