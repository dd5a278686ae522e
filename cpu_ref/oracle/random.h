// The oracle's random numbers: the standard's generator, seeded per pixel and run of samples.
#pragma once

#include <cstdint>
#include <random>

namespace diptych::core::oracle {

/// Finalizer of SplitMix64 (Steele, Lea and Flood 2014): a bijection that scatters neighbours.
inline std::uint64_t scatter_bits(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
}

class Random {
public:
    Random(std::uint64_t seed, std::uint64_t pixel, std::uint64_t run)
        : engine_(scatter_bits(scatter_bits(scatter_bits(seed) ^ pixel) ^ run)) {}

    std::uint64_t bits() { return engine_(); }
    /// Uniform in [0, 1), 53 bits.
    double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
    /// Uniform in 0 .. count-1; count > 0. Its bias, count / 2^53, is far below what any sum could show.
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(uniform() * static_cast<double>(count)); }

private:
    std::mt19937_64 engine_;
};

}  // namespace diptych::core::oracle
