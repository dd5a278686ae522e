// Camera rays.
#ifndef CAMERA_H
#define CAMERA_H

#include "numbers/sampling.h"
#include "language/scene_types.h"

SHARED_BEGIN

/// The ray through a film point and a lens point. `film` is in [0, 1]^2, y down. `lens` is in the unit square, which
/// is mapped to the lens disk about the pinhole. Under an orthographic camera each film point has a lens disk of its
/// own. `direction` is unit. `thin_lens` and `orthographic_allowed` are features: where one is false, the camera's
/// data for it are not read.
FN void camera_ray(IN(Camera) c, vec2 film, vec2 lens, bool thin_lens, bool orthographic_allowed, OUT(vec3) origin,
                   OUT(vec3) direction) {
    float x = 2.0f * film.x - 1.0f;
    float y = 1.0f - 2.0f * film.y;
    PRECISE vec3 across = x * c.right + y * c.up;
    PRECISE vec3 toward = c.forward + across;
    origin = c.origin;
    if (orthographic_allowed && c.kind == CAMERA_ORTHOGRAPHIC) {
        origin = c.origin + across;
        toward = c.forward;
    }
    bool lens_allowed = thin_lens && MUTANT(LENS_IN_PERSPECTIVE_ALONE, true, c.kind == CAMERA_PERSPECTIVE);
    if (lens_allowed && c.lens_radius > 0.0f && c.focus_distance > 0.0f) {
        vec2 disk = sample_disk_concentric(lens) * c.lens_radius;
        vec3 shift = disk.x * normalize(c.right) + disk.y * normalize(c.up);
        origin = origin + shift;
        toward = toward - shift / c.focus_distance;
    }
    direction = normalize(toward);
}

/// Projects a world position through the centre of the lens to a film point in [0, 1]^2, y down. Returns false for a
/// position behind the camera.
FN bool camera_project(IN(Camera) c, vec3 position, OUT(vec2) film) {
    vec3 toward = position - c.origin;
    float along = dot(toward, c.forward);
    film = vec2(0.0f, 0.0f);
    if (!(along > 0.0f)) {
        return false;
    }
    float scale = c.kind == CAMERA_ORTHOGRAPHIC ? 1.0f : 1.0f / along;
    float x = scale * dot(toward, c.right) / dot(c.right, c.right);
    float y = scale * dot(toward, c.up) / dot(c.up, c.up);
    film = vec2(0.5f + 0.5f * x, 0.5f - 0.5f * y);
    return true;
}

SHARED_END

#endif
