// The steps of pack_scene, in the order in which they run.
#pragma once

#include <optional>

#include "pack/mesh_plan.h"
#include "pack/packed_scene.h"

namespace diptych::core {

/// Throws Error where copies of the view would not fill the film: a part of one would reuse pixels that are not there.
void check_atlas(const RenderSettings& settings);

/// Rec. 709 luminance, by which lights and texels of the environment are picked.
inline double luminance(const glm::dvec3& c) {
    return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
}

/// What the settings alone say of the constants.
void pack_settings(const RenderSettings& settings, shared::RenderConstants& constants);

/// Materials, the texture slots that they read and the texels behind those; each image once.
void pack_materials(const Scene& scene, PackedScene& packed);

/// Meshes as planned, their geometries and vertices. Attributes that no feature reads stay out.
void pack_meshes(const Scene& scene, MeshPlan& plan, PackedScene& packed);

/// Instances, moved by -origin.
void pack_instances(const Scene& scene, const MeshPlan& plan, PackedScene& packed);

/// Transform and orientation alone. Where the transform is nearly singular it is thickened (linear_part.h), about the
/// middle of the mesh. Returns a lower bound of what a unit of the mesh's frame is in the world, in any direction;
/// nothing where the instance has no area, or so little size that rays have no place in its mesh's space.
std::optional<double> place_instance(const Instance& instance, const glm::dvec3& origin, const MeshFrame& frame,
                                     double reach, shared::Instance& out);

/// The camera of the settings, moved by -origin; the whole image plane has the aspect of the film.
void pack_camera(const Scene& scene, const RenderSettings& settings, PackedScene& packed);

/// Radiance and alias table of the environment; leaves constants.environment.pmf to pack_lights.
void pack_environment(const Scene& scene, const RenderSettings& settings, PackedScene& packed);

/// Its rotation and scale alone.
void place_environment(const Scene& scene, PackedScene& packed);

/// Its scale over the largest component; 0 where that is 0. What its tables were built under.
glm::vec3 environment_tint(const Environment& environment);

/// Emissive triangles, punctual lights, and what picks among all lights. Needs everything above.
void pack_lights(const Scene& scene, const RenderSettings& settings, PackedScene& packed);

/// Places the lights of one instance anew, its means too where the materials changed.
void place_emitters(PackedScene& packed, std::size_t instance, bool materials_changed);

/// Punctual lights as the scene has them now. Emitters' powers must be known.
void place_punctual_lights(const Scene& scene, PackedScene& packed);

/// Picking probabilities and the light table, from the lights' powers.
void weigh_lights(PackedScene& packed);

/// Which lights stand together, where they are now; for integrators that resample. None where all stand in one place.
void cluster_lights(PackedScene& packed);

/// What the clusters are worth and how their lights are picked, from the probabilities that weigh_lights gives.
void weigh_clusters(PackedScene& packed);

/// Resolves the setting: builds the light tree where the setting wants one and there are two lights to choose from,
/// else removes it. Sets the tree's feature bit. Needs the lights' powers.
void choose_light_sampler(LightSampler wanted, PackedScene& packed);

/// What the light tree's nodes emit, from the lights as they are now; the tree keeps its form.
void weigh_light_tree(PackedScene& packed);

/// What moves becomes the moment before, where reuse will look back to it; until then that is this one.
void keep_previous(PackedScene& packed);

/// A revision that no array has.
std::uint64_t new_revision();

/// Throws Error unless `size` elements of a buffer can be named by 32-bit indices.
void require_indexable(const Scene& scene, std::size_t size, const char* what);

}  // namespace diptych::core
