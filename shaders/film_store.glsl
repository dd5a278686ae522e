// The film in memory. Each sample is traced first and added then, so that no film is kept in registers during a trace.
#ifndef FILM_STORE_GLSL
#define FILM_STORE_GLSL

void add_to_film(uint index, PathSample path) {
    FilmPixel film = addresses.film_pixels.data[index];
    FilmMoments moments;
    FilmFirstHit first_hit;
    if (feature(FEATURE_STANDARD_ERROR)) {
        moments = addresses.film_moments.data[index];
    }
    if (feature(FEATURE_FIRST_HIT_LAYERS)) {
        first_hit = addresses.film_first_hits.data[index];
    }
    add_path(path, film, moments, first_hit);
    addresses.film_pixels.data[index] = film;
    if (feature(FEATURE_STANDARD_ERROR)) {
        addresses.film_moments.data[index] = moments;
    }
    if (feature(FEATURE_FIRST_HIT_LAYERS)) {
        addresses.film_first_hits.data[index] = first_hit;
    }
}

#endif
