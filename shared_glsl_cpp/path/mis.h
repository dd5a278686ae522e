// Multiple importance sampling of two strategies (Veach & Guibas 1995).
#ifndef MIS_H
#define MIS_H

#include "language/scene_types.h"

SHARED_BEGIN

/// MIS weight of a sample drawn with pdf_a where the other strategy has pdf_b, in the same measure. `heuristic` is
/// MIS_POWER (exponent 2) or MIS_BALANCE. The weight is 0 unless pdf_a > 0, and else 1 unless pdf_b > 0. It is
/// computed from the ratio of the pdfs, so that no square overflows.
FN float mis_weight(uint heuristic, float pdf_a, float pdf_b) {
    if (!(pdf_a > 0.0f)) {
        return 0.0f;
    }
    if (!(pdf_b > 0.0f)) {
        return 1.0f;
    }
    float ratio = min(pdf_b, 8.0e37f) / min(pdf_a, 8.0e37f);
    float bounded = min(ratio, heuristic == MIS_POWER ? 1.0e18f : 1.0e37f);  // so that nothing overflows
    return 1.0f / (1.0f + (heuristic == MIS_POWER ? bounded * bounded : bounded));
}

SHARED_END

#endif
