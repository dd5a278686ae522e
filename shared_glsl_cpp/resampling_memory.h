// What resampling keeps for every pixel between its passes, and what a pass is told. A set is one whole film of something.
#ifndef RESAMPLING_MEMORY_H
#define RESAMPLING_MEMORY_H

#include "hit.h"
#include "reservoir.h"
#include "reuse_surface.h"

SHARED_BEGIN

CONST float BSDF_CANDIDATE_NEARBY = 0.125f;  // probability of looking for lamps close by
CONST float BSDF_CANDIDATE_GLOSSY = 0.5f;    // the same on glossy surfaces
CONST float BSDF_SHARE_LEAST = 0.125f;       // that a picked light point gives up where it is looked at and seen
CONST uint CANDIDATE_SAMPLES_BSDF = 1u;
CONST uint CANDIDATE_TESTS_PICKED = 2u;
CONST uint CANDIDATE_IS_CLOSE = 4u;

/// What initial resampling still needs of a pixel once lights were picked, and what it knows by then.
struct CandidateRequest {
    uint pixel;      // its index
    uint needs;      // CANDIDATE_SAMPLES_BSDF and CANDIDATE_TESTS_PICKED; neither: nothing. CANDIDATE_IS_CLOSE: as LightPicker has it
    float near_sum;  // LightPicker::sum, for which it would have to look at all clusters again
};
ASSERT_SIZE(CandidateRequest, 12);

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
    uint iteration;         // of the spatial pass
};
ASSERT_SIZE(ResamplingPass, 24);

SHARED_END

#endif
