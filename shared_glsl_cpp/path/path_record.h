// A record of one path, vertex by vertex, for comparing backends that use the same random numbers. Kernels set the
// fields with the hook RECORD (hooks.md), which does nothing where no path is recorded.
#ifndef PATH_RECORD_H
#define PATH_RECORD_H

#include "geometry/hit.h"
#include "bsdf/lobes.h"
#include "numbers/rng.h"

SHARED_BEGIN

CONST uint SHADOW_NOT_TRACED = 0u;
CONST uint SHADOW_FREE = 1u;
CONST uint SHADOW_BLOCKED = 2u;

CONST uint ROULETTE_NOT_PLAYED = 0u;
CONST uint ROULETTE_SURVIVED = 1u;
CONST uint ROULETTE_KILLED = 2u;

/// The end of one ray of the path, and what happened there. World space; radiance and throughput in linear Rec.709.
struct PathVertexRecord {
    vec3 direction;  // of the ray that ended here
    uint instance;   // NONE: the ray left the scene, and only the emission is valid
    vec3 position;
    uint geometry;
    vec3 normal;  // shading normal, with the normal map
    uint primitive;
    vec3 emission;  // added to the path's radiance, with throughput and MIS weight
    float emission_weight;
    vec3 direct;  // contribution of the sampled light if it is visible, likewise
    float light_pdf;
    vec3 throughput;  // after this vertex, with Russian roulette
    float bsdf_pdf;   // of the sampled direction; its probability for a mirror
    vec2 barycentrics;
    float t;         // distance along the ray, in lengths of `direction`
    float survival;  // survival probability of Russian roulette
    uint light;      // id of the picked light; NONE: no light was sampled
    uint shadow;     // SHADOW_…
    uint lobe;       // LOBE_… | FACET_…
    uint roulette;   // ROULETTE_…
};
ASSERT_SIZE(PathVertexRecord, 128);
ASSERT_OFFSET(PathVertexRecord, barycentrics, 96);

FN PathVertexRecord begin_vertex_record(vec3 direction, IN(Hit) hit) {
    PathVertexRecord v;
    v.direction = direction;
    v.instance = hit.instance;
    v.geometry = hit.instance == NONE ? NONE : hit.geometry;
    v.primitive = hit.instance == NONE ? NONE : hit.primitive;
    v.barycentrics = hit.instance == NONE ? vec2(0.0f, 0.0f) : hit.barycentrics;
    v.t = hit.instance == NONE ? INFINITE_DISTANCE : hit.t;
    v.position = vec3(0.0f, 0.0f, 0.0f);
    v.normal = vec3(0.0f, 0.0f, 0.0f);
    v.emission = vec3(0.0f, 0.0f, 0.0f);
    v.emission_weight = 0.0f;
    v.direct = vec3(0.0f, 0.0f, 0.0f);
    v.light_pdf = 0.0f;
    v.throughput = vec3(0.0f, 0.0f, 0.0f);
    v.bsdf_pdf = 0.0f;
    v.survival = 1.0f;
    v.light = NONE;
    v.shadow = SHADOW_NOT_TRACED;
    v.lobe = LOBE_NONE;
    v.roulette = ROULETTE_NOT_PLAYED;
    return v;
}

/// One sample of one pixel.
struct PathQuery {
    uvec2 pixel;
    uint sample_index;
};
ASSERT_SIZE(PathQuery, 12);

CONST uint SIGNATURE_VERTICES = 16u;

/// The decisions and the radiance of a path. signature[n] is a hash of all decisions up to vertex n; the last entry
/// covers all later vertices too. Entries beyond the path's end repeat the path's last signature.
struct PathSummary {
    vec3 radiance;
    uint vertices;
    uint signature[SIGNATURE_VERTICES];
};
ASSERT_SIZE(PathSummary, 80);

FN PathSummary begin_path_summary() {
    PathSummary s;
    s.radiance = vec3(0.0f, 0.0f, 0.0f);
    s.vertices = 0u;
    for (uint i = 0u; i < SIGNATURE_VERTICES; i++) {
        s.signature[i] = 0u;
    }
    return s;
}

/// Hash of the decisions at a vertex: the triangle hit, the light picked, whether it was occluded, the lobe and the
/// roulette. Measured values are not part of it.
FN uint vertex_decisions(IN(PathVertexRecord) v) {
    uvec4 ids = pcg4d(uvec4(v.instance, v.geometry, v.primitive, v.light));
    return ids.x ^ hash_word(v.shadow | (v.roulette << 4) | (v.lobe << 8));
}

FN void summarize_vertex(INOUT(PathSummary) s, IN(PathVertexRecord) v) {
    uint place = min(s.vertices, SIGNATURE_VERTICES - 1u);
    uint before = s.vertices == 0u ? 0u : s.signature[min(s.vertices - 1u, SIGNATURE_VERTICES - 1u)];
    uint signature = hash_combine(before, vertex_decisions(v));
    for (uint i = place; i < SIGNATURE_VERTICES; i++) {
        s.signature[i] = signature;
    }
    s.vertices += 1u;
}

SHARED_END

#endif
