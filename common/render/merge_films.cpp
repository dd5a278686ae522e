#include "render/merge_films.h"

#include "error.h"
#include "threads.h"

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
    merge_pixels(from, 0, into);
}

void merge_pixels(const Film& from, std::size_t first, Film& into) {
    in_parts(from.pixels.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            merge(from.pixels[i], into.pixels[first + i]);
            if (!into.moments.empty()) {
                merge(from.moments[i].squares, into.moments[first + i].squares);
            }
            if (!into.first_hits.empty()) {
                const shared::FilmFirstHit& hit = from.first_hits[i];
                merge(hit.albedo, into.first_hits[first + i].albedo);
                merge(hit.normal, into.first_hits[first + i].normal);
                merge(hit.depth, into.first_hits[first + i].depth);
            }
        }
    });
}

}  // namespace diptych::core
