// What every pass reads and writes. The barriers between passes are made of it (recorder.h), and a test holds it to
// what the shaders do, as their SPIR-V says.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "commands/hazards.h"
#include "pipelines/pipeline.h"

namespace diptych::core {

struct PassUses {
    std::string_view
        shader;  // a compute shader, or a ray generation shader with the hit and miss shaders that it calls
    std::vector<Use> uses;
};

std::span<const PassUses> pass_table();

/// Of a shader of shaders/ that begins a pass. Throws Error where the table lacks it.
std::span<const Use> uses_of(Spirv shader);

}  // namespace diptych::core
