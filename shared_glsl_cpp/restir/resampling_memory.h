// Data that resampling keeps for every pixel between its passes, and the parameters of a pass. A set is one array over
// the film.
#ifndef RESAMPLING_MEMORY_H
#define RESAMPLING_MEMORY_H

#include "geometry/hit.h"
#include "restir/reservoir.h"
#include "restir/reuse_surface.h"

SHARED_BEGIN

CONST uint BSDF_CANDIDATES_NARROW = 2u;       // material samples per pixel and frame, on narrow lobes
CONST float BSDF_CANDIDATES_GLOSSY = 1.0f;    // on glossy surfaces near lamps; a probability, at most 1
CONST float BSDF_CANDIDATES_NEARBY = 0.125f;  // on other surfaces near lamps
CONST float BSDF_SHARE_LEAST = 0.125f;        // least share that a ray is traced for (share_with_material)
CONST uint CANDIDATE_SAMPLES_BSDF = 1u;
CONST uint CANDIDATE_SHARES = 2u;
CONST uint CANDIDATE_IS_NARROW = 4u;
CONST uint CANDIDATE_IS_CLOSE = 8u;

/// What the passes after initial resampling still have to do for a pixel, and values that they would have to
/// recompute.
struct CandidateRequest {
    uint pixel;      // its index
    uint needs;      // CANDIDATE_… bits: tasks, a narrow lobe, and CandidatePicker::close
    float share;     // of the picked point's weight, lost if no emitter is in front of it
    float near_sum;  // CandidatePicker::sum, which would take a visit to all clusters
};
ASSERT_SIZE(CandidateRequest, 16);

/// A first vertex that is to be shaded.
struct FirstVertex {
    Hit hit;
    vec3 origin;    // of rays that leave it, if it takes light from a reservoir
    uint rays;      // traced for it so far, without the camera ray
    uint occluded;  // 1: the light point of its final reservoir is occluded
};
ASSERT_SIZE(FirstVertex, 44);

struct ResamplingPass {
    uint frame;             // sample index of all pixels
    uint reservoirs;        // the current frame's set, which a pass reads
    uint other_reservoirs;  // temporal: the previous frame's set; spatial: the set of results
    uint surfaces;          // the current frame's set
    uint has_history;       // 0: there is no previous frame
    uint iteration;         // index of the spatial pass or of the material sample
};
ASSERT_SIZE(ResamplingPass, 24);

SHARED_END

#endif
