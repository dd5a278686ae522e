// Every leaf header that kernels use. C++ includes this before `struct Kernel`, so that the kernels' own includes are then empty.
#ifndef LEAVES_H
#define LEAVES_H

#include "alias_table.h"
#include "camera.h"
#include "dimensions.h"
#include "elementary.h"
#include "environment_mapping.h"
#include "film_pixel.h"
#include "frame.h"
#include "hit.h"
#include "light_clusters.h"
#include "mis.h"
#include "path_record.h"
#include "ray_offset.h"
#include "resampling_memory.h"
#include "reservoir.h"
#include "reuse_surface.h"
#include "rng.h"
#include "sampler.h"
#include "sampling.h"
#include "scene_buffers.h"
#include "scene_features.h"
#include "surface_bsdf.h"
#include "triangle_sampling.h"

#endif
