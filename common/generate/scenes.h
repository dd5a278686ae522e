// The generators behind `generate.h`, one source file each: generate_<name>.cpp.
#pragma once

#include "generate/generate.h"

namespace diptych::core {

GeneratedScene generate_cornell(const GenerateOptions& options);
GeneratedScene generate_veach_mis(const GenerateOptions& options);
GeneratedScene generate_brdf_grid(const GenerateOptions& options);
GeneratedScene generate_furnace(const GenerateOptions& options);
GeneratedScene generate_normal_map(const GenerateOptions& options);
GeneratedScene generate_courtyard(const GenerateOptions& options);
GeneratedScene generate_many_lights(const GenerateOptions& options);
GeneratedScene generate_mirror_maze(const GenerateOptions& options);
GeneratedScene generate_moving_light(const GenerateOptions& options);

// generate/extremes.cpp
GeneratedScene generate_extreme_instances(const GenerateOptions& options);
GeneratedScene generate_extreme_near_lamp(const GenerateOptions& options);
GeneratedScene generate_extreme_sun(const GenerateOptions& options);
GeneratedScene generate_extreme_far_room(const GenerateOptions& options);
GeneratedScene generate_extreme_macro(const GenerateOptions& options);
GeneratedScene generate_extreme_wide(const GenerateOptions& options);
GeneratedScene generate_extreme_white_room(const GenerateOptions& options);
GeneratedScene generate_extreme_coplanar(const GenerateOptions& options);
GeneratedScene generate_extreme_broken_mesh(const GenerateOptions& options);
GeneratedScene generate_extreme_normal_map(const GenerateOptions& options);
GeneratedScene generate_extreme_terminator(const GenerateOptions& options);

}  // namespace diptych::core
