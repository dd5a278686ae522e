// main() of an integrator: one pixel's film in, render_pixel, the film out.
void main() {
    uvec2 pixel = dispatch_block.value.origin + gl_LaunchIDEXT.xy;
    uint index = pixel.y * constants.size.x + pixel.x;

    FilmPixel film = addresses.film_pixels.data[index];
    FilmMoments moments;
    moments.first = vec3(0.0f);
    moments.sum_squares = vec3(0.0f);
    moments.compensation = vec3(0.0f);
    FilmFirstHit first_hit;
    first_hit.albedo = vec3(0.0f);
    first_hit.normal = vec3(0.0f);
    first_hit.depth = 0.0f;
    if (feature(FEATURE_STANDARD_ERROR)) {
        moments = addresses.film_moments.data[index];
    }
    if (feature(FEATURE_FIRST_HIT_LAYERS)) {
        first_hit = addresses.film_first_hits.data[index];
    }

    render_pixel(pixel, dispatch_block.value.first_sample, dispatch_block.value.sample_count, film, moments, first_hit);

    addresses.film_pixels.data[index] = film;
    if (feature(FEATURE_STANDARD_ERROR)) {
        addresses.film_moments.data[index] = moments;
    }
    if (feature(FEATURE_FIRST_HIT_LAYERS)) {
        addresses.film_first_hits.data[index] = first_hit;
    }
}
