// Every leaf header that kernels use. C++ includes this file before `struct Kernel`, so that the kernels' own includes
// of leaf headers expand to nothing inside the struct.
#ifndef LEAVES_H
#define LEAVES_H

#include "numbers/alias_table.h"
#include "geometry/camera.h"
#include "numbers/dimensions.h"
#include "numbers/elementary.h"
#include "lights/environment_mapping.h"
#include "film/film_pixel.h"
#include "bsdf/frame.h"
#include "geometry/hit.h"
#include "lights/light_clusters.h"
#include "lights/light_point.h"
#include "lights/light_sample.h"
#include "lights/light_tree.h"
#include "path/integrators.h"
#include "path/mis.h"
#include "path/path_record.h"
#include "geometry/ray_offset.h"
#include "restir/resampling_memory.h"
#include "restir/reservoir.h"
#include "restir/reuse_surface.h"
#include "restir/target.h"
#include "numbers/rng.h"
#include "numbers/sampler.h"
#include "numbers/sampling.h"
#include "language/scene_buffers.h"
#include "language/scene_features.h"
#include "bsdf/surface_bsdf.h"
#include "numbers/triangle_sampling.h"

#endif
