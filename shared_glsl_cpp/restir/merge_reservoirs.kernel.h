// Merges reservoirs of other pixels, or of the frame before, into a pixel's reservoir (GRIS, Lin et al. 2022).
//
// The merge is unbiased for three reasons. A neighbour takes part with its confidence, whatever its reservoir holds.
// Whether it takes part depends on geometry alone. Its MIS weight at a light point uses its own target: at the
// surface, with the lights and occluders, for which its reservoir was made. The favor is in none of these, and it is
// divided out after the selection.
#ifndef MERGE_RESERVOIRS_KERNEL_H
#define MERGE_RESERVOIRS_KERNEL_H

#include "restir/candidates.kernel.h"
#include "restir/target_visibility.kernel.h"

/// The reservoirs to merge: pixels of one set, with the surfaces and the moment that they were made for.
struct Neighborhood {
    uint count;
    uint pixels[RESAMPLING_MAX_NEIGHBORS];
    uint reservoir_set;
    uint surface_set;
    uint moment;
    float confidence_cap;
};

FN Reservoir neighbor_reservoir(IN(Neighborhood) others, uint i) {
    Reservoir r = load_reservoir(others.reservoir_set, others.pixels[i]);
    r.confidence = min(r.confidence, others.confidence_cap);
    r.confidence = MUTANT(REUSE_SKIPS_EMPTY, r.confidence, r.weight > 0.0f ? r.confidence : 0.0f);
    return r;
}

FN TargetSurface neighbor_surface(IN(Neighborhood) others, uint i) {
    return unpack_reuse_surface(load_reuse_surface(others.surface_set, others.pixels[i]), features());
}

/// A random number for the merge of neighbour `i`. The canonical sample uses a number of its own.
FN float pick_number(IN(Sampler) random, uint dimension, uint i) {
    return unit_float(independent_words(random, dimension + i).x);
}

/// Pairwise MIS with defence. A null sample keeps its confidence. The loop evaluates the target twice for each
/// neighbour: of its point here, and of the canonical point there. One call site serves both, because a loop with two
/// traces gave wrong results with NVIDIA's driver (decision 0024).
FN Reservoir merge_pairwise(IN(TargetSurface) own_surface, IN(Reservoir) own, float own_target, IN(Neighborhood) others,
                            float others_confidence, IN(Sampler) random, uint dimension, INOUT(uint) rays) {
    Resampling chosen = begin_resampling();
    float own_share = own.confidence / (others_confidence + own.confidence);
    for (uint k = 0u; k < 2u * others.count; k++) {
        uint i = k >> 1;
        bool there = (k & 1u) != 0u;
        Reservoir r = neighbor_reservoir(others, i);
        TargetSurface surface = own_surface;
        LightPoint point = r.point;
        uint moment = MOMENT_CURRENT;
        bool asks = r.confidence > 0.0f && (there ? own_target > 0.0f : r.weight > 0.0f);
        if (there) {
            surface = neighbor_surface(others, i);
            point = own.point;
            moment = others.moment;
        }
        if (!asks) {
            continue;
        }
        float target = target_at(surface, point, moment, rays);
        if (there) {
            own_share += MUTANT(REUSE_ONE_OVER_M,
                                pairwise_canonical_share(r.confidence, target, own.confidence, own_target, others_confidence),
                                0.0f);
        } else if (target > 0.0f) {
            float share = MUTANT(REUSE_ONE_OVER_M,
                                 pairwise_neighbor_share(r.confidence, r.target, own.confidence, target, others_confidence),
                                 r.confidence / (others_confidence + own.confidence));
            add_reservoir(chosen, r, target, share, pick_number(random, dimension, i));
        }
    }
    if (own_target > 0.0f) {
        add_reservoir(chosen, own, own_target, own_share,
                      pick_number(random, dimension, RESAMPLING_MAX_NEIGHBORS));
    }
    return end_resampling(chosen, 1.0f, others_confidence + own.confidence);
}

/// Sum over all samples of confidence times target at `y`: the denominator of the generalised balance heuristic. For
/// 1/Z (`by_target` false): the sum of the confidences of those that could have produced `y`.
FN float total_at(IN(LightPoint) y, float own_confidence, float own_target, IN(Neighborhood) others, bool by_target,
                  INOUT(uint) rays) {
    float total = own_target > 0.0f ? own_confidence * (by_target ? own_target : 1.0f) : 0.0f;
    for (uint i = 0u; i < others.count; i++) {
        Reservoir r = neighbor_reservoir(others, i);
        float there = target_at(neighbor_surface(others, i), y, others.moment, rays);
        total += there > 0.0f ? r.confidence * (by_target ? there : 1.0f) : 0.0f;
    }
    return total;
}

/// The generalised balance heuristic, as a reference.
FN Reservoir merge_balance(IN(TargetSurface) own_surface, IN(Reservoir) own, float own_target, IN(Neighborhood) others,
                           float others_confidence, IN(Sampler) random, uint dimension, INOUT(uint) rays) {
    Resampling chosen = begin_resampling();
    for (uint i = 0u; i < others.count; i++) {
        Reservoir r = neighbor_reservoir(others, i);
        if (!(r.weight > 0.0f && r.confidence > 0.0f)) {
            continue;
        }
        float here = target_at(own_surface, r.point, MOMENT_CURRENT, rays);
        float total = total_at(r.point, own.confidence, here, others, true, rays);
        if (here > 0.0f && r.target > 0.0f) {
            add_reservoir(chosen, r, here, r.confidence * r.target / total, pick_number(random, dimension, i));
        }
    }
    if (own_target > 0.0f) {
        float total = total_at(own.point, own.confidence, own_target, others, true, rays);
        add_reservoir(chosen, own, own_target, own.confidence * own_target / total,
                      pick_number(random, dimension, RESAMPLING_MAX_NEIGHBORS));
    }
    return end_resampling(chosen, 1.0f, others_confidence + own.confidence);
}

/// Weights by confidence alone. 1/Z divides at the end by the confidences of those that could have produced the
/// selected point; 1/M, which is biased, by all confidences. Bitterli et al. 2020, algorithms 6 and 4.
FN Reservoir merge_by_confidence(IN(TargetSurface) own_surface, IN(Reservoir) own, float own_target,
                                 IN(Neighborhood) others, float others_confidence, IN(Sampler) random, uint dimension,
                                 INOUT(uint) rays) {
    Resampling chosen = begin_resampling();
    for (uint i = 0u; i < others.count; i++) {
        Reservoir r = neighbor_reservoir(others, i);
        if (r.weight > 0.0f) {
            float here = target_at(own_surface, r.point, MOMENT_CURRENT, rays);
            add_reservoir(chosen, r, here, r.confidence, pick_number(random, dimension, i));
        }
    }
    if (own_target > 0.0f) {
        add_reservoir(chosen, own, own_target, own.confidence,
                      pick_number(random, dimension, RESAMPLING_MAX_NEIGHBORS));
    }
    float confidence = others_confidence + own.confidence;
    float total = confidence;
    if (constants.resampling.mis == RESAMPLING_ONE_OVER_Z && chosen.target > 0.0f) {
        total = total_at(chosen.point, own.confidence, chosen.target, others, false, rays);
    }
    return end_resampling(chosen, total > 0.0f ? 1.0f / total : 0.0f, confidence);
}

/// `own` is the pixel's reservoir: the canonical sample, which always takes part.
FN Reservoir merge_reservoirs(IN(TargetSurface) own_surface, IN(Reservoir) own, IN(Neighborhood) others, IN(Sampler) random,
                              uint dimension, INOUT(uint) rays) {
    float others_confidence = 0.0f;
    for (uint i = 0u; i < others.count; i++) {
        Reservoir r = neighbor_reservoir(others, i);
        others_confidence += r.confidence;
    }
    if (!(others_confidence > 0.0f)) {
        return own;
    }
    float own_target = own.weight > 0.0f ? own.target : 0.0f;
    if (constants.resampling.mis == RESAMPLING_PAIRWISE) {
        return merge_pairwise(own_surface, own, own_target, others, others_confidence, random, dimension, rays);
    }
    if (constants.resampling.mis == RESAMPLING_BALANCE) {
        return merge_balance(own_surface, own, own_target, others, others_confidence, random, dimension, rays);
    }
    return merge_by_confidence(own_surface, own, own_target, others, others_confidence, random, dimension, rays);
}

#endif
