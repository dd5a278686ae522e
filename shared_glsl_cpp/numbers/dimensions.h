// The dimension of each random draw. Each draw has a fixed dimension, so that a path can be replayed on either
// backend, and so that a change of one decision leaves the other draws unchanged.
#ifndef DIMENSIONS_H
#define DIMENSIONS_H

#include "language/compat.h"

SHARED_BEGIN

CONST uint DIMENSION_FILM = 0u;  // two
CONST uint DIMENSION_LENS = 2u;  // two

/// The n-th surface vertex of a path uses the dimensions from DIMENSION_VERTEX + n * DIMENSIONS_PER_VERTEX on. The
/// constants below are offsets.
CONST uint DIMENSION_VERTEX = 4u;
CONST uint DIMENSIONS_PER_VERTEX = 12u;
CONST uint DIMENSION_BSDF_DIRECTION = 0u;   // two
CONST uint DIMENSION_LOBE = 2u;             // two: lobe; facet of a microfacet normal map
CONST uint DIMENSION_LIGHT_PICK = 4u;       // two, as bits: column of the alias table; keep or alias
CONST uint DIMENSION_LIGHT_POSITION = 6u;   // two
CONST uint DIMENSION_ENVIRONMENT = 8u;       // two, as bits: column of the map's alias table; keep or alias
CONST uint DIMENSION_ROULETTE = 10u;        // one; the other is unused

// Resampling draws four words per dimension (independent_words). Its dimensions are beyond those of a path.
CONST uint DIMENSION_CANDIDATE = 0x10000u;         // + candidate
CONST uint DIMENSION_CANDIDATE_PICK = 0x20000u;    // + candidate: selection; words for the environment
CONST uint DIMENSION_BSDF_CANDIDATE = 0x30000u;    // + 2 i: direction of material sample i; + 2 i + 1: its selection
CONST uint DIMENSION_TEMPORAL = 0x40000u;
CONST uint DIMENSION_NEIGHBOR = 0x50000u;          // + pass * (RESAMPLING_MAX_NEIGHBORS + 1) + neighbour: its position
CONST uint DIMENSION_NEIGHBOR_PICK = 0x60000u;     // likewise: the selection
CONST uint DIMENSION_CLUSTER = 0x70000u;           // offset of the steps through the clusters of lights

SHARED_END

#endif
