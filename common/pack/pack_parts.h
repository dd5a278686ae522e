// The steps of pack_scene, in the order in which they run.
#pragma once

#include "pack/packed_scene.h"

namespace diptych {

/// Materials, the texture slots that they read and the texels behind those; each image once.
void pack_materials(const Scene& scene, PackedScene& packed);

/// Meshes, their geometries and vertices. Attributes that no feature reads stay out.
void pack_meshes(const Scene& scene, PackedScene& packed);

/// Instances, moved by -origin. One whose transform has no inverse is left out with a warning.
void pack_instances(const Scene& scene, const glm::dvec3& origin, PackedScene& packed);

/// The camera of the settings, moved by -origin; the whole image plane has the aspect of the film.
void pack_camera(const Scene& scene, const RenderSettings& settings, const glm::dvec3& origin, PackedScene& packed);

/// Radiance and alias table of the environment; leaves constants.environment.pmf to pack_lights. Returns the mean luminance over
/// the sphere.
double pack_environment(const Scene& scene, const RenderSettings& settings, PackedScene& packed);

/// Emissive triangles, punctual lights and the table that picks among all lights. Needs everything above.
void pack_lights(const Scene& scene, const RenderSettings& settings, const glm::dvec3& origin, double environment_luminance,
                 PackedScene& packed);

/// Throws Error unless `size` elements of a buffer can be named by 32-bit indices.
void require_indexable(const Scene& scene, std::size_t size, const char* what);

}  // namespace diptych
