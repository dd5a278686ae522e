// Every probe, with its bound, as X(probe, bound, inputs in a million that may take another path, why). Floats may
// differ by `bound` * 2^-23 * the scale that the probe states; 0 demands the same bits. Vulkan promises correctly
// rounded +, -, * (half a unit on each side, and a product may be fused with a sum), division within 2.5 units,
// inversesqrt within 2 and sqrt as 1/inversesqrt, thus 4.5; dot, length and normalize are made of these. A bound adds
// up what the longest chain of operations may lose so.
#ifndef PROBE_LIST_H
#define PROBE_LIST_H

#include "probes_bsdf.h"
#include "probes_numbers.h"
#include "probes_resampling.h"
#include "probes_sampling.h"
#include "probes_surface.h"

#define PROBE_LIST(X)                                                                                                  \
    NUMBER_PROBES(X)                                                                                                   \
    SAMPLING_PROBES(X)                                                                                                 \
    BSDF_PROBES(X)                                                                                                     \
    SURFACE_PROBES(X)                                                                                                  \
    RESAMPLING_PROBES(X)

#endif
