// Picking from an alias table (Walker 1977; Vose 1991): two words, one load.
#ifndef ALIAS_TABLE_H
#define ALIAS_TABLE_H

#include "language/scene_types.h"

SHARED_BEGIN

/// A column below `count`, all alike to within count/2^32.
FN uint alias_column(uint bits, uint count) {
    return multiply_high(bits, count);
}

/// The column, or its alias. All 32 bits count, and probability 1 always keeps.
FN uint alias_pick(IN(AliasEntry) e, uint column, uint bits) {
    if (e.probability >= 1.0f) {
        return column;
    }
    uint threshold = uint(max(e.probability, 0.0f) * 4294967296.0f);
    return MUTANT(ALIAS_SWAPPED, bits < threshold, bits >= threshold) ? column : e.alias;
}

SHARED_END

#endif
