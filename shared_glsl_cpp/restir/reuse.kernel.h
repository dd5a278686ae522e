// Merging reservoirs of other pixels, or of the frame before, into a pixel's own (GRIS, Lin et al. 2022).
//
// What keeps this unbiased: a neighbour takes part, with its confidence, whatever its reservoir holds; whether it takes part depends on
// geometry alone; and its share of a light point is the target at the surface, among the lights and past the occluders, that its
// reservoir was made for. Its favor is in none of these, and what is chosen loses it again.
#ifndef REUSE_KERNEL_H
#define REUSE_KERNEL_H

#include "restir/candidates.kernel.h"
#include "restir/target_visibility.kernel.h"

/// Reservoirs to merge: pixels of one set, with the surfaces and the lights they were made for.
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

/// One random number for each merge of neighbour `i`; the canonical sample takes one of its own.
FN float pick_number(IN(Sampler) random, uint dimension, uint i) {
    return unit_float(independent_words(random, dimension + i).x);
}

/// Pairwise MIS with defence. A null sample keeps its confidence. Each neighbour is asked for twice, for its point here and for the
/// own point there, and by one call: where the loop held two traces, NVIDIA's driver gave wrong answers (decision 0024).
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

/// Confidence times target at `y`, summed over all that take part: the denominator of the generalised balance heuristic; or, for
/// 1/Z, the confidences alone of those that could have made it.
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

/// The generalised balance heuristic, for reference.
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

/// Weights by confidence alone, put right at the end by those that could have made the chosen point (1/Z), or not put right (1/M,
/// biased): Bitterli et al. 2020, algorithms 6 and 4.
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

/// `own`: the pixel's reservoir, the canonical sample, which always takes part.
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
