// The resources that every pass reads and writes. Barriers between passes are derived from this table (recorder.h). A
// test compares it with the SPIR-V of the shaders.
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

/// The uses of a shader that begins a pass. Throws Error if the table does not list it.
std::span<const Use> uses_of(Spirv shader);

}  // namespace diptych::core
