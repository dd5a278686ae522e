// Weighted reservoirs in the form of GRIS (Lin et al. 2022): a selected light point y and its unbiased contribution
// weight W, so that f(y) W estimates the integral of f. Light points are in uv measure. In it, reuse between pixels
// and frames is the identity shift with Jacobian 1, even for lights that move or scale.
#ifndef RESERVOIR_H
#define RESERVOIR_H

#include "lights/light_point.h"

SHARED_BEGIN

CONST float TARGET_MIN = 1.0e-20f;  // a target below it counts as 0

struct Reservoir {
    LightPoint point;
    float weight;      // W, per unit of uv measure; 0: a null sample
    float confidence;  // c, in units of one initial reservoir
    float target;      // p̂ of the point at the surface where the reservoir was made
    float favor;       // factor of its weight in merges: 1, or FAVOR_HIDDEN
};
ASSERT_SIZE(Reservoir, 28);

/// The favor of a point that was occluded when a shadow ray last tested it, for this pixel or for one it came from: it
/// is likely to be occluded again. A merge selects such a point with a smaller probability, and end_resampling divides
/// the favor out of W. The expectation is the same for every positive favor, so the MIS weights do not depend on it; a
/// target with visibility would change them. Why 1/2: docs/decisions/0014-favor.md.
CONST float FAVOR_HIDDEN = 0.5f;

FN Reservoir empty_reservoir() {
    Reservoir r;
    r.point = no_light_point();
    r.weight = 0.0f;
    r.confidence = 0.0f;
    r.target = 0.0f;
    r.favor = 1.0f;
    return r;
}

/// Streaming selection of one candidate, in proportion to its weight.
struct Resampling {
    LightPoint point;
    float target;  // of the selected point
    float favor;   // likewise
    float weight_sum;
    float weight_lost;  // rounding error of the sum; without it the sum stops growing beyond 2^24 equal weights
};

FN Resampling begin_resampling() {
    Resampling s;
    s.point = no_light_point();
    s.target = 0.0f;
    s.favor = 1.0f;
    s.weight_sum = 0.0f;
    s.weight_lost = 0.0f;
    return s;
}

/// Adds a candidate with resampling weight w = m p̂(y) W, times `favor`; u is in [0, 1). Weights that are not positive
/// and finite are ignored.
FN void add_favored_candidate(INOUT(Resampling) s, IN(LightPoint) point, float target, float w, float favor, float u) {
    float weight = favor * w;
    if (!(target > MUTANT(TARGET_CUT_OFF, TARGET_MIN, 0.1f)) || !(weight > 0.0f && weight < INFINITE_DISTANCE)) {
        return;
    }
    PRECISE float added = weight + s.weight_lost;
    PRECISE float total = s.weight_sum + added;
    PRECISE float lost = added - (total - s.weight_sum);  // Kahan 1965
    s.weight_sum = total;
    s.weight_lost = MUTANT(RESERVOIR_SUM_PLAIN, abs(lost) < INFINITE_DISTANCE, false) ? lost : 0.0f;
    if (u * s.weight_sum < weight) {
        s.point = point;
        s.target = target;
        s.favor = favor;
    }
}

/// Adds a candidate whose visibility has never been tested.
FN void add_candidate(INOUT(Resampling) s, IN(LightPoint) point, float target, float w, float u) {
    add_favored_candidate(s, point, target, w, 1.0f, u);
}

/// Adds the selection of another resampling with MIS weight m. `target` is its target at the current surface.
FN void add_reservoir(INOUT(Resampling) s, IN(Reservoir) r, float target, float m, float u) {
    add_favored_candidate(s, r.point, target, m * target * r.weight, r.favor, u);
}

/// Ends with W = scale · Σw / (p̂(y) · favor of y).
FN Reservoir end_resampling(IN(Resampling) s, float scale, float confidence) {
    Reservoir r;
    r.point = s.point;
    float chosen_by = s.target * MUTANT(FAVOR_STAYS, s.favor, 1.0f);
    r.weight = s.target > 0.0f ? scale * (s.weight_sum / chosen_by) : 0.0f;
    r.weight = MUTANT(RESERVOIR_CLAMPED, r.weight, min(r.weight, 1.0f));
    r.confidence = confidence;
    r.target = s.target;
    r.favor = MUTANT(FAVOR_FORGOTTEN, s.favor, 1.0f);
    if (!(r.weight > 0.0f && r.weight < INFINITE_DISTANCE)) {
        r.point = no_light_point();
        r.weight = 0.0f;
    }
    return r;
}

// MIS weights between reservoirs. Index i is a neighbour with confidence c_i, index c the canonical sample. S = Σ c_i
// over the neighbours, C = S + c_c. Pairwise MIS with defence: Bitterli 2022, ch. 9; Lin et al. 2022, supplement.

/// m_i at the neighbour's own sample.
FN float pairwise_neighbor_share(float c_i, float target_i, float c_canonical, float target_canonical, float s) {
    float own = s * target_i;
    float both = own + c_canonical * target_canonical;
    return both > 0.0f ? (s / (s + c_canonical)) * (c_i / s) * (own / both) : 0.0f;
}

/// The term of one neighbour in m_c at the canonical sample. m_c is the sum over neighbours plus c_c / C.
FN float pairwise_canonical_share(float c_i, float target_i, float c_canonical, float target_canonical, float s) {
    float own = c_canonical * target_canonical;
    float both = own + s * target_i;
    return both > 0.0f ? (c_i / (s + c_canonical)) * (own / both) : 0.0f;
}

SHARED_END

#endif
