// main() of an integrator: each sample is traced and then added to its pixel's film, so that no film is kept while rays are.
void main() {
    uvec2 pixel = dispatch_block.value.origin + gl_LaunchIDEXT.xy;
    uint index = pixel.y * constants.size.x + pixel.x;

    for (uint i = 0u; i < dispatch_block.value.sample_count; i += 1u) {
        PathSample path = trace_path(pixel, dispatch_block.value.first_sample + i);

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
}
