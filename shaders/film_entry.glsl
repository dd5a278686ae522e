// main() of an integrator. All rays are traced in one place: an invocation whose path ends begins its next sample, and one that needs no
// shadow ray goes on along its path, while others still trace theirs.
#include "film_store.glsl"

void main() {
    uvec2 pixel = dispatch_block.value.origin + gl_LaunchIDEXT.xy;
    uint index = pixel.y * constants.size.x + pixel.x;
    uint sample_index = dispatch_block.value.first_sample;
    uint end = sample_index + dispatch_block.value.sample_count;
    if (sample_index == end) {
        return;
    }
    PathState path = begin_path(pixel, sample_index);
    while (true) {
        bool shadow = awaits_shadow_ray(path);
        vec3 direction = shadow ? path.direct.direction : path.direction;
        float t_max = shadow ? path.direct.t_max : INFINITE_DISTANCE;
        Hit hit = trace_either(path.origin, direction, t_max, shadow, shadow ? shadow_ray_key(path) : next_ray_key(path));
        if (shadow) {
            settle_direct_light(path, hit.instance != NONE);
        } else {
            extend_path(path, hit);
        }
        if (path.goes_on || awaits_shadow_ray(path)) {
            continue;
        }
        add_to_film(index, path.found);
        sample_index += 1u;
        if (sample_index == end) {
            break;
        }
        path = begin_path(pixel, sample_index);
    }
}
