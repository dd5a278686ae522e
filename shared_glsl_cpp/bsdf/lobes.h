// The lobe that a direction was sampled from.
#ifndef LOBES_H
#define LOBES_H

#include "language/compat.h"

SHARED_BEGIN

CONST uint LOBE_NONE = 0u;  // a null sample
CONST uint LOBE_DIFFUSE = 1u;
CONST uint LOBE_SPECULAR = 2u;
CONST uint LOBE_MIRROR = 3u;

// Added to the lobe where a normal map tilts: the facets that the path met, the mapped one, the tangent one or both.
CONST uint FACET_MAPPED = 4u;
CONST uint FACET_TANGENT = 8u;

SHARED_END

#endif
