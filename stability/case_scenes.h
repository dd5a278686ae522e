// Whole pictures for the cases: scenes small enough to have a closed form, rendered as any other.
#pragma once

#include "case_parts.h"
#include "render/film.h"
#include "generate/shapes.h"

namespace diptych::core::stability {

/// Plain settings: independent samples, one depth, the path integrator.
RenderSettings settings_of(int width, int height, std::uint32_t max_depth);

Film render(Backend& backend, const Scene& scene, const RenderSettings& settings, std::uint32_t spp);

/// White or grey, diffuse alone.
Material diffuse(float albedo);

/// A level square about `center`, front up or down.
Primitive level_square(const dvec3& center, double half, bool front_up, int material);

/// The inside of a box: fronts look inward.
Primitive room(const glm::vec3& low, const glm::vec3& high, int material);

void add_camera(Scene& scene, const dvec3& eye, const dvec3& target, double degrees);
void add_sky(Scene& scene, float radiance);

/// The mean of all pixels, red.
double mean_of(const Film& film);
double worst_of(const Film& film, double truth);  // relative, of any pixel's mean

/// Error, dropped samples and their count of a film of which the mean should be `truth`.
Measured judge_mean(const Film& film, double truth);

}  // namespace diptych::core::stability
