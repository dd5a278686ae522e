// What resampling keeps for every pixel between its passes, and what a pass is told. A set is one whole film of something.
#ifndef RESAMPLING_MEMORY_H
#define RESAMPLING_MEMORY_H

#include "geometry/hit.h"
#include "restir/reservoir.h"
#include "restir/reuse_surface.h"

SHARED_BEGIN

CONST uint BSDF_CANDIDATES_NARROW = 2u;       // a pixel and frame, on narrow lobes
CONST float BSDF_CANDIDATES_GLOSSY = 1.0f;    // on glossy surfaces with lamps close by; at most 1, and below it a probability
CONST float BSDF_CANDIDATES_NEARBY = 0.125f;  // on others with lamps close by
CONST float BSDF_SHARE_LEAST = 0.125f;        // that a picked point gives up where it is asked to
CONST uint CANDIDATE_SAMPLES_BSDF = 1u;
CONST uint CANDIDATE_SHARES = 2u;
CONST uint CANDIDATE_IS_NARROW = 4u;
CONST uint CANDIDATE_IS_CLOSE = 8u;

/// What initial resampling still needs of a pixel once lights were picked, and what it knows by then.
struct CandidateRequest {
    uint pixel;      // its index
    uint needs;      // CANDIDATE_SAMPLES_BSDF, CANDIDATE_SHARES; IS_NARROW: samples BSDF_CANDIDATES_NARROW times; IS_CLOSE: as CandidatePicker has it
    float share;     // of what was picked, that it gives up if no emitter is before it
    float near_sum;  // CandidatePicker::sum, for which it would have to look at all clusters again
};
ASSERT_SIZE(CandidateRequest, 16);

/// A first vertex that waits to be shaded.
struct FirstVertex {
    Hit hit;
    vec3 origin;    // where its rays start, if it takes light from a reservoir
    uint rays;      // traced for it so far, beside the camera's
    uint occluded;  // 1: the light point that its reservoir ended with is hidden from it
};
ASSERT_SIZE(FirstVertex, 44);

struct ResamplingPass {
    uint frame;             // the sample index of all pixels
    uint reservoirs;        // set of this frame's, which a pass reads
    uint other_reservoirs;  // temporal: set of the frame before's; spatial: where the results go
    uint surfaces;          // set of this frame's
    uint has_history;       // 0: there is no frame before
    uint iteration;         // of the spatial pass, and of sampling the material
};
ASSERT_SIZE(ResamplingPass, 24);

SHARED_END

#endif
