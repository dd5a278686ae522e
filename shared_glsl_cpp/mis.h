// Multiple importance sampling of two strategies (Veach & Guibas 1995).
#ifndef MIS_H
#define MIS_H

#include "scene_types.h"

SHARED_BEGIN

/// Weight of a sample drawn with pdf_a that the other strategy has with pdf_b, same measure; heuristic is MIS_POWER
/// (exponent 2) or MIS_BALANCE. 0 unless pdf_a > 0, 1 unless pdf_b > 0; by the pdfs' ratio, so no square overflows.
FN float mis_weight(uint heuristic, float pdf_a, float pdf_b) {
    if (!(pdf_a > 0.0f)) {
        return 0.0f;
    }
    if (!(pdf_b > 0.0f)) {
        return 1.0f;
    }
    float a = min(pdf_a, 8.0e37f);
    float b = min(pdf_b, 8.0e37f);
    float ratio = min(a, b) / max(a, b);
    float part = heuristic == MIS_POWER ? ratio * ratio : ratio;
    return a >= b ? 1.0f / (1.0f + part) : part / (1.0f + part);
}

SHARED_END

#endif
