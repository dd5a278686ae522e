// Every leaf header as GLSL, each with a call, so that a header that compiles only as C++ breaks the build.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "numbers/alias_table.h"
#include "geometry/camera.h"
#include "numbers/elementary.h"
#include "lights/environment_mapping.h"
#include "bsdf/frame.h"
#include "path/mis.h"
#include "geometry/ray_offset.h"
#include "numbers/rng.h"
#include "numbers/sampler.h"
#include "numbers/sampling.h"
#include "film/tonemap.h"
#include "numbers/triangle_sampling.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) buffer Output { float results[]; };
layout(push_constant, scalar) uniform Input {
    Camera camera;
    Sampler random;
    AliasEntry entry;
};

void main() {
    Sampler s = random;
    s.sample_index = gl_GlobalInvocationID.x;
    vec2 u = sample_2d(s, DIMENSION_FILM);
    float v = sample_1d(s, DIMENSION_VERTEX);
    vec3 origin;
    vec3 direction;
    camera_ray(camera, u, sample_2d(s, DIMENSION_LENS), true, true, origin, direction);
    Frame frame = frame_from_normal(direction);
    vec3 local = sample_cosine_hemisphere(u) + sample_uniform_hemisphere(u) + sample_uniform_sphere(u);
    vec3 p = offset_ray(origin, to_world(frame, to_local(frame, local)), abs(origin));
    TriangleSample triangle = sample_triangle_solid_angle(p, origin, frame.tangent, frame.bitangent, u);
    float pdf = pdf_triangle_solid_angle(p, origin, frame.tangent, frame.bitangent, origin);
    vec2 uv = environment_uv(environment_direction(u, vec2(1.0f, 0.0f)), vec2(0.0f, 1.0f));
    uvec2 bits = sample_bits_2d(s, DIMENSION_VERTEX);
    uint pick = alias_pick(entry, alias_column(bits.x, 7u), bits.y);
    float sum = mis_weight(MIS_POWER, triangle.pdf, pdf) + log1p_poly(v) + pow_poly(v, u.x) + arccos(v) + uv.x;
    sum += pdf_environment_solid_angle(v, uvec2(8u, 4u), uv.y) + unit_float(hash_combine(pick, 3u));
    vec3 color = srgb_encode(tonemap(pick, vec3(sum, sum, v)));
    results[gl_GlobalInvocationID.x] = luminance(color) + srgb_decode(v) + triangle.barycentrics.x;
}
