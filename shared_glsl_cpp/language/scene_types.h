// Every struct that both CPU and GPU code read, in scalar layout. World space is the scene's, translated by the
// packer.
#ifndef SCENE_TYPES_H
#define SCENE_TYPES_H

#include "language/compat.h"

SHARED_BEGIN

/// An instance of a mesh: x' = (row_0, row_1, row_2) · (x, 1).
struct Instance {
    vec4 row_0;
    vec4 row_1;
    vec4 row_2;
    uint first_geometry;      // index into geometries: the mesh's primitives, in order
    uint first_emitter_slot;  // index into emitter_slots, one per primitive; NONE where nothing emits
    uint mirrored;            // 1 where the determinant of the matrix is negative
};
ASSERT_SIZE(Instance, 60);
ASSERT_OFFSET(Instance, first_geometry, 48);

/// One glTF primitive. Attribute offsets count elements of the attribute's own buffer; NONE where it is missing.
struct Geometry {
    uint first_triangle;
    uint first_vertex;  // index into positions
    uint first_normal;
    uint first_tangent;
    uint first_uv_0;  // this and the next: index into uvs
    uint first_uv_1;
    uint first_color;
    uint material;
};
ASSERT_SIZE(Geometry, 32);

CONST uint MATERIAL_ALPHA_MASK = 1u;
CONST uint MATERIAL_ALPHA_BLEND = 2u;
CONST uint MATERIAL_DOUBLE_SIDED = 4u;  // emits from both sides
CONST uint MATERIAL_UNLIT = 8u;         // only emits
CONST uint MATERIAL_EMISSIVE = 16u;     // its emission may be non-zero somewhere

/// glTF 2.0 metallic-roughness; see `Material` of common. Slots index texture_slots; NONE where there is no texture.
struct Material {
    vec4 base_color;
    vec3 emission;  // radiance, W/(sr m^2)
    float metallic;
    vec3 specular_color;
    float roughness;
    float specular;
    float f0;  // reflectance of the dielectric at normal incidence, from its index of refraction
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

CONST uint TEXTURE_SRGB = 1u;    // rgb is decoded by the sRGB curve
CONST uint TEXTURE_NEAREST = 2u;
CONST uint TEXTURE_UV_1 = 4u;
CONST uint WRAP_REPEAT = 0u;
CONST uint WRAP_CLAMP = 1u;
CONST uint WRAP_MIRROR = 2u;
CONST uint TEXTURE_WRAP_U_SHIFT = 4u;  // two bits each
CONST uint TEXTURE_WRAP_V_SHIFT = 6u;

/// A texture as one material reads it: (u', v') = (u_row, v_row) · (u, v, 1); texel (x, y) is first_texel + y * width
/// + x.
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
CONST uint EMITTER_VARIES = 2u;    // textured or not opaque: its radiance varies over the triangle
CONST uint EMITTER_PART_SHIFT = 8u;  // higher bits: its part of a cluster + 1, or 0 for none

/// An emissive triangle x = vertex_0 + b_1 edge_1 + b_2 edge_2, in world space. Its light id is in [0,
/// emissive_triangle_count).
struct EmissiveTriangle {
    vec3 vertex_0;
    float pmf;  // probability of being picked among all lights
    vec3 edge_1;
    uint flags;
    vec3 edge_2;
    uint geometry;  // with `primitive`: where the texture coordinates of the emission are
    vec3 radiance;  // the material's emission factor, without its texture
    uint primitive; // index of the triangle within the geometry
    vec3 front;     // unit normal, on the side that emits
    float double_area;
};
ASSERT_SIZE(EmissiveTriangle, 80);

CONST uint PUNCTUAL_POINT = 0u;
CONST uint PUNCTUAL_SPOT = 1u;
CONST uint PUNCTUAL_DIRECTIONAL = 2u;

/// KHR_lights_punctual. Light ids follow those of emissive triangles. The environment, if any, is the last light.
struct PunctualLight {
    vec3 position;
    uint type;
    vec3 direction;  // unit, in which the light shines
    float pmf;
    vec3 intensity;  // W/sr; directional: W/m^2
    float cone_scale;   // spot: falloff = saturate(cos * cone_scale + cone_offset)^2
    float cone_offset;
    uint part;          // index of its part of a cluster; NONE where it is in none
};
ASSERT_SIZE(PunctualLight, 56);

/// One column of an alias table (Walker 1977; Vose 1991): keep the column with `probability`, else take `alias`.
struct AliasEntry {
    float probability;
    uint alias;
};
ASSERT_SIZE(AliasEntry, 8);

/// Number of light clusters. Every shading point visits all clusters, so more clusters cost time, and fewer are wider.
CONST uint CLUSTER_GROUPS = 16u;
CONST uint CLUSTERS_PER_GROUP = 8u;  // unused clusters at the end have no lights
CONST uint MOST_CLUSTERS = CLUSTER_GROUPS * CLUSTERS_PER_GROUP;
CONST uint PARTS_PER_CLUSTER = 8u;

/// Lights that are close together (light_clusters.h): a cluster, or a part of a cluster. The array holds all clusters
/// first, then their parts: those of cluster k start at light_cluster_count + k * PARTS_PER_CLUSTER.
struct LightCluster {
    vec3 center;   // mean position, weighted by pmf
    float spread;  // m²: mean square of the lights' distance from the center
    float pmf;     // probability that picking by power picks one of its lights
    uint first;    // index into cluster_picks
    uint count;    // number of picks; for a cluster, of its parts
    float radius;  // m: distance from center to the farthest light plus that light's rms size
};
ASSERT_SIZE(LightCluster, 32);

/// A column of the alias table of a cluster's lights: keep `light` with `probability`, else take `alias`. Both are
/// light ids.
struct ClusterPick {
    float probability;
    uint light;
    uint alias;
};
ASSERT_SIZE(ClusterPick, 12);

CONST uint LIGHT_NODE_WIDTH = 8u;
CONST uint LIGHT_LEAF = 0x80000000u;         // of LightNode::child: a leaf's first entry in leaf_picks; else a node
CONST uint LIGHT_LEAF_SIZE_SHIFT = 25u;      // six bits: lights of the leaf, less one
CONST uint MOST_LIGHTS_PER_LEAF = 64u;
CONST uint LIGHT_LEAF_FIRST = 0x01ffffffu;

/// A node of the light tree (light_tree.h): what each of its children emits, and from where. Unused children have
/// power 0. Arrays over the children, so that the CPU evaluates all of them at once.
struct LightNode {
    float center_x[8];  // mean position; of lights at infinity, the mean direction to them
    float center_y[8];
    float center_z[8];
    float place[8];     // 1, or 0 for lights at infinity
    float spread[8];    // m²: mean square of the distance from the center; positive
    float axis_x[8];    // mean normal
    float axis_y[8];
    float axis_z[8];
    float blur[8];      // positive: how far the normals scatter about their mean
    float front[8];     // share of the emission that is one-sided
    float power[8];     // over the largest of the node's children
    uint child[8];      // LIGHT_LEAF | …, or a node
};
ASSERT_SIZE(LightNode, 384);

/// A column of the alias table of a leaf's lights, with their shares of the leaf's power.
struct LeafPick {
    float probability;  // of `light`; else `alias`
    uint light;
    float light_share;
    uint alias;
    float alias_share;
};
ASSERT_SIZE(LeafPick, 20);

/// Where a light or a node stands in the light tree.
struct LightPlace {
    uint slot;    // node * LIGHT_NODE_WIDTH + child; NONE for the root
    float share;  // of a light: its share of its leaf's power
};
ASSERT_SIZE(LightPlace, 8);

CONST uint CAMERA_PERSPECTIVE = 0u;
CONST uint CAMERA_ORTHOGRAPHIC = 1u;

/// The camera. Film point (x, y) in [-1, 1]^2, y up, is seen along forward + x right + y up, unnormalised
/// (perspective), or from origin + x right + y up along forward (orthographic).
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

/// Light from infinity. A texel of the map is a vec4: radiance, and the probability of picking that texel.
struct Environment {
    vec3 scale;
    uint kind;
    vec2 rotation;  // cosine and sine of the rotation about +Y
    uvec2 size;
    float pmf;  // probability of being picked among all lights
};
ASSERT_SIZE(Environment, 36);

/// How reservoirs are made and reused (restir.kernel.h).
struct ResamplingConstants {
    uint light_candidates;  // light candidates per pixel and frame
    uint near_candidates;   // those of them that are picked from clusters by distance; at least one is picked by power
    uint bsdf_candidates;   // 0 or 1: candidates also come from sampling the material
    uint temporal;          // 1: merge the reservoirs of the frame before
    uint spatial_passes;
    uint neighbors;         // per spatial pass, at most RESAMPLING_MAX_NEIGHBORS
    float radius;           // of the disk in which neighbours lie, pixels
    float confidence_cap;   // on the frame before, in units of the current frame's confidence
    uint mis;               // RESAMPLING_…
    uint visibility;        // VISIBILITY_…
    float reach;            // metres, for one candidate: picking by power rarely finds points nearer; 0: no emitters
};
ASSERT_SIZE(ResamplingConstants, 44);

CONST uint RESAMPLING_MAX_NEIGHBORS = 8u;
CONST uint RESAMPLING_PAIRWISE = 0u;            // pairwise MIS with defence, O(N)
CONST uint RESAMPLING_BALANCE = 1u;             // the generalised balance heuristic, O(N^2): the reference
CONST uint RESAMPLING_ONE_OVER_Z = 2u;          // Bitterli et al. 2020, algorithm 6
CONST uint RESAMPLING_BIASED_ONE_OVER_M = 3u;   // Bitterli et al. 2020, algorithm 4
CONST uint VISIBILITY_IN_SHADING = 0u;          // the target ignores visibility; one shadow ray to the selected point
CONST uint VISIBILITY_IN_TARGET = 1u;           // the target is 0 in shadow, at every surface that takes part
CONST uint VISIBILITY_BIASED_INITIAL = 2u;      // occluded candidates are dropped; the MIS weights ignore this
CONST uint VISIBILITY_BIASED_FINAL = 3u;        // a selected point that is occluded is not passed on

CONST uint MOMENT_CURRENT = 0u;
CONST uint MOMENT_PREVIOUS = 1u;  // the moment of the frame before, for reuse

/// Constants of a whole render.
struct RenderConstants {
    Camera camera;
    Environment environment;
    uvec2 size;  // of the film, pixels
    uint seed;
    uint sampler_kind;  // SAMPLER_…
    uint sample_count;  // size of the Hammersley set
    uint max_depth;     // number of scattering events
    uint integrator;    // INTEGRATOR_… (path/integrators.h)
    uint brdf;          // BRDF_…
    uint normal_maps;   // NORMAL_MAP_…
    uint mis;           // MIS_…
    uint light_sampler; // LIGHT_SAMPLER_…
    uint light_count;
    uint emissive_triangle_count;
    uint punctual_light_count;
    uint light_cluster_count;
    uint atlas_tile;    // 0, or the side of square copies of the view; reuse does not cross copies
    Camera previous_camera;
    ResamplingConstants resampling;
};
ASSERT_SIZE(RenderConstants, 264);

CONST uint BRDF_GGX = 0u;
CONST uint BRDF_BLINN_PHONG = 1u;
// What a normal map does to a surface.
CONST uint NORMAL_MAP_NONE = 0u;
CONST uint NORMAL_MAP_SHADING = 1u;     // mapped_bsdf.h
CONST uint NORMAL_MAP_MICROFACET = 2u;  // facet_pair_bsdf.h
CONST uint MIS_POWER = 0u;
CONST uint MIS_BALANCE = 1u;
// How a path picks a light at a vertex.
CONST uint LIGHT_SAMPLER_UNIFORM = 0u;  // all lights alike
CONST uint LIGHT_SAMPLER_POWER = 1u;    // by the light's power, with a share for all alike
CONST uint LIGHT_SAMPLER_SPATIAL = 2u;  // by the light tree (light_tree.h)

SHARED_END

#endif
