// The film's structs in the device's memory (film_layout.h). What has not changed is not written.
#ifndef FILM_WORDS_GLSL
#define FILM_WORDS_GLSL

#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

#include "film_layout.h"
#include "film/film_pixel.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FilmWords { uint data[]; };

// One struct of the film.
struct FilmPlace {
    FilmWords words;
    uint pixel;
    uint stride;  // words of the struct
};

uint load_word(FilmPlace at, uint word) { return at.words.data[film_word(at.pixel, at.stride, word)]; }
uvec2 load_words2(FilmPlace at, uint first) { return uvec2(load_word(at, first), load_word(at, first + 1u)); }
uvec3 load_words3(FilmPlace at, uint first) { return uvec3(load_words2(at, first), load_word(at, first + 2u)); }

void store_word(FilmPlace at, uint word, uint before, uint after) {
    if (before != after) {
        at.words.data[film_word(at.pixel, at.stride, word)] = after;
    }
}

void store_words2(FilmPlace at, uint first, uvec2 before, uvec2 after) {
    store_word(at, first, before.x, after.x);
    store_word(at, first + 1u, before.y, after.y);
}

void store_words3(FilmPlace at, uint first, uvec3 before, uvec3 after) {
    store_words2(at, first, before.xy, after.xy);
    store_word(at, first + 2u, before.z, after.z);
}

ExactSum load_exact_sum(FilmPlace at) {
    ExactSum s;
    for (uint k = 0u; k < 3u; ++k) {
        s.low[k] = load_words3(at, 3u * k);
        s.high[k] = load_words3(at, 9u + 3u * k);
    }
    s.base = load_word(at, 18u);
    return s;
}

void store_exact_sum(FilmPlace at, ExactSum before, ExactSum after) {
    for (uint k = 0u; k < 3u; ++k) {
        store_words3(at, 3u * k, before.low[k], after.low[k]);
        store_words3(at, 9u + 3u * k, before.high[k], after.high[k]);
    }
    store_word(at, 18u, before.base, after.base);
}

FilmPlace film_pixel_place(uvec2 address, uint pixel) { return FilmPlace(FilmWords(address), pixel, FILM_PIXEL_WORDS); }
FilmPlace film_moments_place(uvec2 address, uint pixel) { return FilmPlace(FilmWords(address), pixel, FILM_MOMENTS_WORDS); }
FilmPlace film_first_hit_place(uvec2 address, uint pixel) {
    return FilmPlace(FilmWords(address), pixel, FILM_FIRST_HIT_WORDS);
}

FilmPixel load_film_pixel(FilmPlace at) {
    FilmPixel pixel;
    pixel.sum = load_exact_sum(at);
    pixel.samples = load_word(at, 19u);
    pixel.nonfinite = load_word(at, 20u);
    pixel.rays = load_word(at, 21u);
    pixel.ray_wraps = load_word(at, 22u);
    return pixel;
}

void store_film_pixel(FilmPlace at, FilmPixel before, FilmPixel after) {
    store_exact_sum(at, before.sum, after.sum);
    store_word(at, 19u, before.samples, after.samples);
    store_word(at, 20u, before.nonfinite, after.nonfinite);
    store_word(at, 21u, before.rays, after.rays);
    store_word(at, 22u, before.ray_wraps, after.ray_wraps);
}

FilmFirstHit load_film_first_hit(FilmPlace at) {
    FilmFirstHit hit;
    hit.albedo.low = load_words3(at, 0u);
    hit.albedo.high = load_words3(at, 3u);
    hit.normal.low = load_words3(at, 6u);
    hit.normal.high = load_words3(at, 9u);
    hit.depth.low = load_words2(at, 12u);
    hit.depth.high = load_words2(at, 14u);
    hit.depth.base = load_word(at, 16u);
    return hit;
}

void store_film_first_hit(FilmPlace at, FilmFirstHit before, FilmFirstHit after) {
    store_words3(at, 0u, before.albedo.low, after.albedo.low);
    store_words3(at, 3u, before.albedo.high, after.albedo.high);
    store_words3(at, 6u, before.normal.low, after.normal.low);
    store_words3(at, 9u, before.normal.high, after.normal.high);
    store_words2(at, 12u, before.depth.low, after.depth.low);
    store_words2(at, 14u, before.depth.high, after.depth.high);
    store_word(at, 16u, before.depth.base, after.depth.base);
}

#endif
