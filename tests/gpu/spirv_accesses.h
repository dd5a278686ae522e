// Which memory a shader reads and writes, as its SPIR-V says.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace diptych::core::tests {

struct Accesses {
    bool reads = false;
    bool writes = false;  // atomics too
};

/// By name: of the block that a pointer points to ("wave_paths"; a buffer's type is called NAME_buffer in GLSL), with
/// the element's member where that alone is accessed ("wave_paths.radiance"); of a structure of rays, "structures".
/// Throws Error for a pointer into such memory that cannot be followed.
std::map<std::string, Accesses> memory_accesses(std::span<const std::uint32_t> spirv);

}  // namespace diptych::core::tests
