// The generators behind `generate.h`, one source file each: generate_<name>.cpp.
#pragma once

#include "scene/generate.h"

namespace diptych {

GeneratedScene generate_cornell(const GenerateOptions& options);
GeneratedScene generate_veach_mis(const GenerateOptions& options);
GeneratedScene generate_brdf_grid(const GenerateOptions& options);
GeneratedScene generate_furnace(const GenerateOptions& options);
GeneratedScene generate_normal_map(const GenerateOptions& options);
GeneratedScene generate_courtyard(const GenerateOptions& options);
GeneratedScene generate_many_lights(const GenerateOptions& options);
GeneratedScene generate_mirror_maze(const GenerateOptions& options);
GeneratedScene generate_moving_light(const GenerateOptions& options);

}  // namespace diptych
