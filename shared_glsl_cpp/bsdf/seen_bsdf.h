// The BSDF at a hit, in world space, and what is common to all directions seen from one wo. There are three normals:
// the triangle's, the interpolated one and the normal map's.
#ifndef SEEN_BSDF_H
#define SEEN_BSDF_H

#include "bsdf/bsdf.h"
#include "bsdf/frame.h"

SHARED_BEGIN

struct SurfaceBsdf {
    BsdfParameters parameters;
    vec3 geometric_normal;  // unit, on wo's side
    vec3 shading_normal;    // unit, interpolated, on the geometric normal's side
    vec3 mapped_normal;     // unit; equals shading_normal where there is no map
    uint mapped;            // NORMAL_MAP_…: from the material's map and the render's settings
};

/// How a normal map acts that gives `mapped_normal`: NORMAL_MAP_NONE where it does not tilt the normal.
FN uint normal_map_model(uint model, vec3 shading_normal, vec3 mapped_normal) {
    vec3 tilt = mapped_normal - shading_normal;
    return dot(tilt, tilt) > 1.0e-10f ? model : NORMAL_MAP_NONE;
}

struct SeenBsdf {
    vec3 wo;
    bool reflects;        // wo is on the triangle's outer side
    vec3 normal;          // of the specular lobe
    vec3 diffuse_normal;  // equals `normal` where there is no map
    Frame frame;          // about `normal`; undefined where facets represent the map
    vec3 wo_local;        // in that frame
    float p_specular;     // bsdf_specular_probability
    uint mapped;          // NORMAL_MAP_…: also NONE where the map does not tilt the normal
};

SHARED_END

#endif
