#version 460
#extension GL_GOOGLE_include_directive : require

#include "scene_hooks.glsl"
#include "path/path.kernel.h"
#include "wave_paths.glsl"
#include "film_store.glsl"

layout(local_size_x = WAVE_GROUP) in;

// Adds the paths of one pixel to the film, in order of their samples.
void main() {
    uint pixel = gl_GlobalInvocationID.x;
    if (pixel >= slice_pixels()) {
        return;
    }
    uvec2 place = path_pixel(pixel);
    uint index = place.y * constants.size.x + place.x;
    FilmEntry before = load_film(index);
    FilmEntry film = before;
    for (uint path = pixel; path < slice_paths(); path += slice_pixels()) {
        PathSample found;
        found.radiance = addresses.wave_paths.data[path].radiance;
        found.rays = addresses.wave_paths.data[path].rays;
        found.first_hit = no_first_hit();
        if (feature(FEATURE_FIRST_HIT_LAYERS)) {
            found.first_hit = addresses.wave_first_hits.data[path];
        }
        add_path(found, film.pixel, film.moments, film.first_hit);
    }
    store_film(index, before, film);
}
