#include "render/merge_films.h"

#include "error.h"

namespace diptych::core {

namespace {

using shared::uint;

/// 64-bit bins as pairs of words.
void add_bin(uint from_low, uint from_high, uint& low, uint& high) {
    low += from_low;
    high += from_high + (low < from_low ? 1U : 0U);
}

void merge(const shared::ExactSum& from, shared::ExactSum& into) {
    shared::raise_base(into, static_cast<int>(from.base) + 2);
    for (uint k = into.base - from.base, to = 0; k < 3; ++k, ++to) {
        for (int c = 0; c < 3; ++c) {
            add_bin(from.low[k][c], from.high[k][c], into.low[to][c], into.high[to][c]);
        }
    }
}

void merge(const shared::ExactScalar& from, shared::ExactScalar& into) {
    shared::raise_base(into, static_cast<int>(from.base) + 1);
    for (int k = static_cast<int>(into.base - from.base), to = 0; k < 2; ++k, ++to) {
        add_bin(from.low[k], from.high[k], into.low[to], into.high[to]);
    }
}

void merge(const shared::FixedSum& from, shared::FixedSum& into) {
    for (int c = 0; c < 3; ++c) {
        add_bin(from.low[c], from.high[c], into.low[c], into.high[c]);
    }
}

void merge(const shared::FilmPixel& from, shared::FilmPixel& into) {
    merge(from.sum, into.sum);
    into.samples += from.samples;
    into.nonfinite += from.nonfinite;
    const std::uint64_t rays = std::uint64_t{into.rays} + from.rays;
    into.rays = static_cast<uint>(rays);
    into.ray_wraps += from.ray_wraps + static_cast<uint>(rays >> 32U);
}

}  // namespace

void merge_films(const Film& from, Film& into) {
    if (from.width != into.width || from.height != into.height || from.moments.size() != into.moments.size() ||
        from.first_hits.size() != into.first_hits.size()) {
        throw Error("films of different sizes or layers cannot be merged");
    }
    for (std::size_t i = 0; i < into.pixels.size(); ++i) {
        merge(from.pixels[i], into.pixels[i]);
    }
    for (std::size_t i = 0; i < into.moments.size(); ++i) {
        merge(from.moments[i].squares, into.moments[i].squares);
    }
    for (std::size_t i = 0; i < into.first_hits.size(); ++i) {
        merge(from.first_hits[i].albedo, into.first_hits[i].albedo);
        merge(from.first_hits[i].normal, into.first_hits[i].normal);
        merge(from.first_hits[i].depth, into.first_hits[i].depth);
    }
}

}  // namespace diptych::core
