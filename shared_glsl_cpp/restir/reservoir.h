// Weighted reservoirs in the form of GRIS (Lin et al. 2022): a chosen light point y and its unbiased contribution weight W, so that
// f(y) W estimates the integral of f. Light points live in uv measure, in which reuse between pixels and frames is the identity shift
// with Jacobian 1, even for lights that move or scale.
#ifndef RESERVOIR_H
#define RESERVOIR_H

#include "lights/light_point.h"

SHARED_BEGIN

CONST float TARGET_MIN = 1.0e-20f;  // a target below it counts as 0

struct Reservoir {
    LightPoint point;
    float weight;      // W, per unit of uv measure; 0: a null sample
    float confidence;  // c, in initial samplings
    float target;      // p̂ of the point, where the reservoir was made
    float favor;       // multiplies its weights wherever it is merged: 1, or FAVOR_HIDDEN
};
ASSERT_SIZE(Reservoir, 28);

/// Of a point that was hidden when a shadow ray last asked, for this pixel or for whom it came from: it is likely to be hidden again. So it is
/// chosen less often, and where it is, its favor is divided out of W (end_resampling). The expectation is the same whatever positive number
/// that is, so no m_i need know of it, as they would of a target with visibility. Why a half: docs/decisions/0014-favor.md.
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

/// Candidates passing by; one is kept in proportion to its weight.
struct Resampling {
    LightPoint point;
    float target;  // of the kept point
    float favor;   // likewise
    float weight_sum;
    float weight_lost;  // what rounding took from the sum: beyond 2^24 equal weights it would stand still
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

/// A candidate of resampling weight w = m p̂(y) W, times `favor`; u in [0, 1). What is not a positive finite number is passed over.
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

/// A candidate of which nobody knows whether it is seen.
FN void add_candidate(INOUT(Resampling) s, IN(LightPoint) point, float target, float w, float u) {
    add_favored_candidate(s, point, target, w, 1.0f, u);
}

/// What another resampling chose, where its point has the target `target`, with the share m.
FN void add_reservoir(INOUT(Resampling) s, IN(Reservoir) r, float target, float m, float u) {
    add_favored_candidate(s, r.point, target, m * target * r.weight, r.favor, u);
}

/// W = scale · Σw / (p̂(y) · y's favor).
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

// Multiple importance sampling between reservoirs. Index i is a neighbour with confidence c_i, c the canonical sample; S = Σ c_i over
// the neighbours, C = S + c_c. Pairwise with defence: Bitterli 2022, ch. 9; Lin et al. 2022, supplement.

/// m_i at the neighbour's own sample.
FN float pairwise_neighbor_share(float c_i, float target_i, float c_canonical, float target_canonical, float s) {
    float own = s * target_i;
    float both = own + c_canonical * target_canonical;
    return both > 0.0f ? (s / (s + c_canonical)) * (c_i / s) * (own / both) : 0.0f;
}

/// What one neighbour leaves of m_c at the canonical sample; the sum over neighbours, plus c_c / C, is m_c.
FN float pairwise_canonical_share(float c_i, float target_i, float c_canonical, float target_canonical, float s) {
    float own = c_canonical * target_canonical;
    float both = own + s * target_i;
    return both > 0.0f ? (c_i / (s + c_canonical)) * (own / both) : 0.0f;
}

SHARED_END

#endif
