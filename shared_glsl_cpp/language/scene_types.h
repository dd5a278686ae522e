// Every struct that crosses the bus, once, in scalar layout. World space is the scene's, rebased by the packer.
#ifndef SCENE_TYPES_H
#define SCENE_TYPES_H

#include "language/compat.h"

SHARED_BEGIN

/// A mesh placed in the world; x' = (row_0, row_1, row_2) · (x, 1).
struct Instance {
    vec4 row_0;
    vec4 row_1;
    vec4 row_2;
    uint first_geometry;      // into geometries: the mesh's primitives, in order
    uint first_emitter_slot;  // into emitter_slots, one per primitive; NONE where nothing of the mesh emits
    uint mirrored;            // 1 where the determinant is negative
};
ASSERT_SIZE(Instance, 60);
ASSERT_OFFSET(Instance, first_geometry, 48);

/// One glTF primitive. Attribute offsets count elements of their own buffer; NONE where the attribute is missing.
struct Geometry {
    uint first_triangle;
    uint first_vertex;  // into positions
    uint first_normal;
    uint first_tangent;
    uint first_uv_0;  // both into uvs
    uint first_uv_1;
    uint first_color;
    uint material;
};
ASSERT_SIZE(Geometry, 32);

CONST uint MATERIAL_ALPHA_MASK = 1u;
CONST uint MATERIAL_ALPHA_BLEND = 2u;
CONST uint MATERIAL_DOUBLE_SIDED = 4u;  // emits from both sides
CONST uint MATERIAL_UNLIT = 8u;         // black but for its emission
CONST uint MATERIAL_EMISSIVE = 16u;     // its emission can be non-zero somewhere

/// glTF 2.0 metallic-roughness; see `Material` of common. Slots index texture_slots, NONE where there is no texture.
struct Material {
    vec4 base_color;
    vec3 emission;  // radiance, W/(sr m^2)
    float metallic;
    vec3 specular_color;
    float roughness;
    float specular;
    float f0;  // normal reflectance of the dielectric, from its index of refraction
    float normal_scale;
    float alpha_cutoff;
    uint flags;
    uint base_color_slot;
    uint metallic_roughness_slot;
    uint normal_slot;
    uint emission_slot;
    uint specular_slot;
    uint specular_color_slot;
};
ASSERT_SIZE(Material, 92);
ASSERT_OFFSET(Material, flags, 64);

CONST uint TEXTURE_SRGB = 1u;    // rgb decode by the sRGB curve
CONST uint TEXTURE_NEAREST = 2u;
CONST uint TEXTURE_UV_1 = 4u;
CONST uint WRAP_REPEAT = 0u;
CONST uint WRAP_CLAMP = 1u;
CONST uint WRAP_MIRROR = 2u;
CONST uint TEXTURE_WRAP_U_SHIFT = 4u;  // two bits each
CONST uint TEXTURE_WRAP_V_SHIFT = 6u;

/// A texture as one material reads it: (u', v') = (u_row, v_row) · (u, v, 1), then texels first_texel + y * width + x.
struct TextureSlot {
    uint first_texel;
    uint width;
    uint height;
    uint flags;
    vec3 u_row;
    vec3 v_row;
};
ASSERT_SIZE(TextureSlot, 40);

CONST uint EMITTER_TWO_SIDED = 1u;
CONST uint EMITTER_VARIES = 2u;    // textured or not opaque: its radiance depends on the place, and the material knows it
CONST uint EMITTER_PART_SHIFT = 8u;  // above: its part of a cluster + 1, or 0

/// A light that a ray can hit: x = vertex_0 + b_1 edge_1 + b_2 edge_2, in world space. Lights 0 .. emissive_triangle_count-1.
struct EmissiveTriangle {
    vec3 vertex_0;
    float pmf;  // of being picked among all lights
    vec3 edge_1;
    uint flags;
    vec3 edge_2;
    uint geometry;  // with primitive: where the texture coordinates are, for a textured emission
    vec3 radiance;  // the material's factor, before its texture
    uint primitive; // index within the geometry
    vec3 front;     // unit normal, to the side that emits
    float double_area;
};
ASSERT_SIZE(EmissiveTriangle, 80);

CONST uint PUNCTUAL_POINT = 0u;
CONST uint PUNCTUAL_SPOT = 1u;
CONST uint PUNCTUAL_DIRECTIONAL = 2u;

/// KHR_lights_punctual. Lights emissive_triangle_count .. +punctual_light_count-1; the environment, if any, is the last light.
struct PunctualLight {
    vec3 position;
    uint type;
    vec3 direction;  // where it shines to, unit
    float pmf;
    vec3 intensity;  // W/sr; directional: W/m^2
    float cone_scale;   // spot: falloff = saturate(cos * cone_scale + cone_offset)^2
    float cone_offset;
    uint part;          // of a cluster; NONE: of none
};
ASSERT_SIZE(PunctualLight, 56);

/// One column of an alias table (Walker 1977; Vose 1991): keep the column with `probability`, else take `alias`.
struct AliasEntry {
    float probability;
    uint alias;
};
ASSERT_SIZE(AliasEntry, 8);

/// Every place looks at all clusters, so more cost time; fewer are wider.
CONST uint CLUSTER_GROUPS = 16u;
CONST uint CLUSTERS_PER_GROUP = 8u;  // the last group too, with clusters of no light
CONST uint MOST_CLUSTERS = CLUSTER_GROUPS * CLUSTERS_PER_GROUP;
CONST uint PARTS_PER_CLUSTER = 8u;

/// Lights that stand together (light_clusters.h): a cluster, or a part of one. All clusters come first; then their parts, of cluster k
/// from light_cluster_count + k * PARTS_PER_CLUSTER on, as many as it has.
struct LightCluster {
    vec3 center;   // by pmf
    float spread;  // m²: the mean square of the lights' distance from it
    float pmf;     // of picking one of them by power
    uint first;    // into cluster_picks
    uint count;    // of picks; of a cluster: of its parts
    float radius;  // m: all lights are within it, as far as they shine
};
ASSERT_SIZE(LightCluster, 32);

/// A column of the alias table by which a cluster's lights are picked: keep `light` with `probability`, else take `alias`, both light ids.
struct ClusterPick {
    float probability;
    uint light;
    uint alias;
};
ASSERT_SIZE(ClusterPick, 12);

CONST uint CAMERA_PERSPECTIVE = 0u;
CONST uint CAMERA_ORTHOGRAPHIC = 1u;

/// A film point (x, y) in [-1, 1]^2, y up, is seen along forward + x right + y up (perspective, unnormalised) or from
/// origin + x right + y up along forward (orthographic).
struct Camera {
    vec3 origin;
    uint kind;
    vec3 right;
    float lens_radius;
    vec3 up;
    float focus_distance;
    vec3 forward;  // unit
};
ASSERT_SIZE(Camera, 60);

CONST uint ENVIRONMENT_NONE = 0u;
CONST uint ENVIRONMENT_CONSTANT = 1u;
CONST uint ENVIRONMENT_MAP = 2u;

/// Light from infinity. The map's texels are vec4: radiance, and the probability of picking that texel.
struct Environment {
    vec3 scale;
    uint kind;
    vec2 rotation;  // cosine and sine of the turn about +Y
    uvec2 size;
    float pmf;  // of being picked among all lights
};
ASSERT_SIZE(Environment, 36);

/// How reservoirs are made and reused (restir.kernel.h).
struct ResamplingConstants {
    uint light_candidates;  // a pixel and frame, picked among all lights
    uint near_candidates;   // of these, picked from clusters by their distance; at least one is picked by power alone
    uint bsdf_candidates;   // 0 or 1: also by sampling the material
    uint temporal;          // 1: reuse the frame before
    uint spatial_passes;
    uint neighbors;         // a spatial pass, at most RESAMPLING_MAX_NEIGHBORS
    float radius;           // of their disk, pixels
    float confidence_cap;   // of the frame before, in this frame's confidences
    uint mis;               // RESAMPLING_…
    uint visibility;        // VISIBILITY_…
    float reach;            // metres, of one candidate: power alone picks nearer emitters too seldom; 0: there are none
};
ASSERT_SIZE(ResamplingConstants, 44);

CONST uint RESAMPLING_MAX_NEIGHBORS = 8u;
CONST uint RESAMPLING_PAIRWISE = 0u;            // with defence, O(N)
CONST uint RESAMPLING_BALANCE = 1u;             // the generalised balance heuristic, O(N^2): the reference
CONST uint RESAMPLING_ONE_OVER_Z = 2u;          // Bitterli et al. 2020, algorithm 6
CONST uint RESAMPLING_BIASED_ONE_OVER_M = 3u;   // the same, algorithm 4
CONST uint VISIBILITY_IN_SHADING = 0u;          // the target knows none; one shadow ray at the end
CONST uint VISIBILITY_IN_TARGET = 1u;           // the target is 0 in shadow, at every surface that takes part
CONST uint VISIBILITY_BIASED_INITIAL = 2u;      // candidates in shadow are dropped, and MIS weights do not know
CONST uint VISIBILITY_BIASED_FINAL = 3u;        // what proves shadowed at the end is not handed on

CONST uint MOMENT_CURRENT = 0u;
CONST uint MOMENT_PREVIOUS = 1u;  // which reuse looks back to

/// What stays the same for a whole render.
struct RenderConstants {
    Camera camera;
    Environment environment;
    uvec2 size;  // of the film, pixels
    uint seed;
    uint sampler_kind;  // SAMPLER_…
    uint sample_count;  // the total that a Hammersley set is laid out for
    uint max_depth;     // scattering events
    uint integrator;    // INTEGRATOR_… (path/integrators.h)
    uint brdf;          // BRDF_…
    uint normal_maps;   // NORMAL_MAP_…
    uint mis;           // MIS_…
    uint light_count;
    uint emissive_triangle_count;
    uint punctual_light_count;
    uint light_cluster_count;
    uint atlas_tile;    // 0, or the side of square copies of the view, each isolated from the others
    Camera previous_camera;
    ResamplingConstants resampling;
};
ASSERT_SIZE(RenderConstants, 260);

CONST uint BRDF_GGX = 0u;
CONST uint BRDF_BLINN_PHONG = 1u;
// What a normal map does to a surface.
CONST uint NORMAL_MAP_NONE = 0u;
CONST uint NORMAL_MAP_SHADING = 1u;     // mapped_bsdf.h
CONST uint NORMAL_MAP_MICROFACET = 2u;  // facet_pair_bsdf.h
CONST uint MIS_POWER = 0u;
CONST uint MIS_BALANCE = 1u;

SHARED_END

#endif
