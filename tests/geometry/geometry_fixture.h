// One scene on both panels and by the oracle, and transforms that hardly have an inverse.
#pragma once

#include <glm/glm.hpp>
#include <random>

#include "catch.h"
#include "pack/packed_scene.h"
#include "render/film.h"
#include "generate/shapes.h"
#include "vulkan_device.h"

namespace diptych::core::tests {

struct Films {
    Film cpu;
    Film vulkan;
    Film oracle;
};

/// Independent samples with standard errors; both panels take the same random numbers, the oracle others.
RenderSettings geometry_settings(int width, int height, std::uint32_t max_depth);

Film render_cpu(const PackedScene& packed, std::uint32_t spp);
/// On one device for all pictures of the process.
Film render_vulkan(const PackedScene& packed, std::uint32_t spp);
Film render_oracle(const Scene& scene, const RenderSettings& settings, std::uint32_t spp);
Films render_everywhere(const Scene& scene, const RenderSettings& settings, std::uint32_t spp);

/// Samples that were no numbers, in all of them.
std::uint64_t count_nonfinite(const Films& films);

struct MeanAndError {
    double mean = 0;
    double error = 0;  // standard
};

/// Of the red of a rectangle of pixels.
MeanAndError mean_of(const Film& film, int left, int top, int width, int height);
MeanAndError mean_of(const Film& film);

/// A rotation and a scale a node, one to four of them. Scales are near 1, 0, or 10 to the power of up to ±20.
glm::dmat3 random_chain(std::mt19937_64& random);

/// One of a square, a box, a sphere, about 2 m across.
Primitive random_shape(std::mt19937_64& random, int material);

/// Both faces of a black surface shine, radiance 1; or both scatter, white.
Material lamp_material();
Material white_material();

/// A directional light along (x, y, z) under which a white surface that faces it has radiance 1.
PunctualLight sun_along(const glm::dvec3& direction);

}  // namespace diptych::core::tests
