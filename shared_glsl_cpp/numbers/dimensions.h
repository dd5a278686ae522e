// Which random number is for what. Every draw has a fixed place, so that a path can be replayed on either backend and a change in
// one decision moves no other.
#ifndef DIMENSIONS_H
#define DIMENSIONS_H

#include "language/compat.h"

SHARED_BEGIN

CONST uint DIMENSION_FILM = 0u;  // two
CONST uint DIMENSION_LENS = 2u;  // two

/// Dimensions of the path's n-th surface vertex start at DIMENSION_VERTEX + n * DIMENSIONS_PER_VERTEX; the rest are offsets to it.
CONST uint DIMENSION_VERTEX = 4u;
CONST uint DIMENSIONS_PER_VERTEX = 12u;
CONST uint DIMENSION_BSDF_DIRECTION = 0u;   // two
CONST uint DIMENSION_LOBE = 2u;             // two: lobe, facet of a normal map
CONST uint DIMENSION_LIGHT_PICK = 4u;       // two, as bits: column of the alias table, keep or alias
CONST uint DIMENSION_LIGHT_POSITION = 6u;   // two
CONST uint DIMENSION_ENVIRONMENT = 8u;       // two, as bits: column of the map's alias table, keep or alias
CONST uint DIMENSION_ROULETTE = 10u;        // one; the other is spare

// Resampling draws four words at a dimension of its own, far from a path's.
CONST uint DIMENSION_CANDIDATE = 0x10000u;         // + candidate
CONST uint DIMENSION_CANDIDATE_PICK = 0x20000u;    // + candidate: which is kept, and words for the environment
CONST uint DIMENSION_BSDF_CANDIDATE = 0x30000u;    // + 2 * time: direction; + 2 * time + 1: which is kept, and at time 0 what to do
CONST uint DIMENSION_TEMPORAL = 0x40000u;
CONST uint DIMENSION_NEIGHBOR = 0x50000u;          // + pass * (RESAMPLING_MAX_NEIGHBORS + 1) + neighbour: where it lies
CONST uint DIMENSION_NEIGHBOR_PICK = 0x60000u;     // likewise: which sample is kept
CONST uint DIMENSION_CLUSTER = 0x70000u;           // where the steps through the clusters of lights begin

SHARED_END

#endif
