// The film in memory. Samples are traced first and added then, so that no film is kept in registers during a trace.
#ifndef FILM_STORE_GLSL
#define FILM_STORE_GLSL

#include "film_words.glsl"

// One pixel's film, to which samples are added.
struct FilmEntry {
    FilmPixel pixel;
    FilmMoments moments;
    FilmFirstHit first_hit;
};

FilmEntry load_film(uint index) {
    FilmEntry film;
    film.pixel = load_film_pixel(film_pixel_place(uvec2(addresses.film_pixels), index));
    if (feature(FEATURE_STANDARD_ERROR)) {
        film.moments.squares = load_exact_sum(film_moments_place(uvec2(addresses.film_moments), index));
    }
    if (feature(FEATURE_FIRST_HIT_LAYERS)) {
        film.first_hit = load_film_first_hit(film_first_hit_place(uvec2(addresses.film_first_hits), index));
    }
    return film;
}

void store_film(uint index, FilmEntry before, FilmEntry after) {
    store_film_pixel(film_pixel_place(uvec2(addresses.film_pixels), index), before.pixel, after.pixel);
    if (feature(FEATURE_STANDARD_ERROR)) {
        store_exact_sum(film_moments_place(uvec2(addresses.film_moments), index), before.moments.squares,
                        after.moments.squares);
    }
    if (feature(FEATURE_FIRST_HIT_LAYERS)) {
        store_film_first_hit(film_first_hit_place(uvec2(addresses.film_first_hits), index), before.first_hit,
                             after.first_hit);
    }
}

void add_to_film(uint index, PathSample path) {
    FilmEntry before = load_film(index);
    FilmEntry film = before;
    add_path(path, film.pixel, film.moments, film.first_hit);
    store_film(index, before, film);
}

#endif
