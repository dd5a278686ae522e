// Picking from an alias table (Walker 1977; Vose 1991), from two random words with one load.
#ifndef ALIAS_TABLE_H
#define ALIAS_TABLE_H

#include "language/scene_types.h"

SHARED_BEGIN

/// A column below `count`. Each column has the same probability up to count/2^32.
FN uint alias_column(uint bits, uint count) {
    return multiply_high(bits, count);
}

/// Returns the column or its alias. All 32 bits are compared, and probability 1 always keeps the column.
FN uint alias_pick(IN(AliasEntry) e, uint column, uint bits) {
    if (e.probability >= 1.0f) {
        return column;
    }
    uint threshold = uint(max(e.probability, 0.0f) * 4294967296.0f);
    return MUTANT(ALIAS_SWAPPED, bits < threshold, bits >= threshold) ? column : e.alias;
}

SHARED_END

#endif
