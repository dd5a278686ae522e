// Random numbers that are the same on every machine and with every standard library. Not for rendering.
#pragma once

#include <cstdint>

namespace diptych::core {

/// SplitMix64 (Steele, Lea and Flood 2014).
struct GeneratorRandom {
    std::uint64_t state = 0;

    std::uint64_t next() {
        std::uint64_t z = (state += 0x9e3779b97f4a7c15U);
        z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31U);
    }
    double uniform() { return double(next() >> 11U) * 0x1p-53; }  // [0, 1)
    double between(double low, double high) { return low + (high - low) * uniform(); }
    std::uint64_t below(std::uint64_t count) { return std::uint64_t(uniform() * double(count)); }
};

}  // namespace diptych::core
