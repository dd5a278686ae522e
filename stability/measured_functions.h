// Every measured function, as X(name).
#ifndef MEASURED_FUNCTIONS_H
#define MEASURED_FUNCTIONS_H

#include "measured_geometry.h"
#include "measured_microfacets.h"
#include "measured_sums.h"

#define MEASURED_FUNCTIONS(X)                                                                                          \
    MEASURED_MICROFACETS(X)                                                                                            \
    MEASURED_GEOMETRY(X)                                                                                               \
    MEASURED_SUMS(X)

#endif
