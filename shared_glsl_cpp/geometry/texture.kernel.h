// Textures, filtered in shared code over raw texels, so that both backends get the same value.
#ifndef TEXTURE_KERNEL_H
#define TEXTURE_KERNEL_H

#include "leaves.h"

/// Brings one coordinate near [0, 1] by its wrap mode. This happens before the coordinate is scaled to texels, so that
/// large coordinates keep their fraction. NaN becomes 0.
FN float wrapped_coordinate(float u, uint mode) {
    float w = u;
    if (mode == WRAP_REPEAT) {
        w = u - floor(u);
    } else if (mode == WRAP_MIRROR) {
        w = u - 2.0f * floor(0.5f * u);
    } else {
        w = min(max(u, 0.0f), 1.0f);
    }
    return w >= 0.0f && w <= 2.0f ? w : 0.0f;
}

/// Texel index in [0, size). The input may be at most one texel outside the range of wrapped_coordinate.
FN uint wrapped_texel(int i, uint size, uint mode) {
    int n = int(size);
    if (mode == WRAP_REPEAT) {
        return uint(i < 0 ? i + n : (i >= n ? i - n : i));
    }
    if (mode == WRAP_MIRROR) {
        int j = i < 0 ? -1 - i : i;
        j = j >= 2 * n ? j - 2 * n : j;
        return uint(j >= n ? 2 * n - 1 - j : j);
    }
    return uint(clamp(i, 0, n - 1));
}

FN vec4 texel_fetch(uint slot_first_texel, uint index, bool srgb) {
    uint word = load_texels(slot_first_texel + index);
    float a = float(word >> 24) * (1.0f / 255.0f);
    uint r = word & 255u;
    uint g = (word >> 8) & 255u;
    uint b = (word >> 16) & 255u;
    if (srgb) {
        return vec4(load_srgb_table(r), load_srgb_table(g), load_srgb_table(b), a);
    }
    return vec4(float(r) * (1.0f / 255.0f), float(g) * (1.0f / 255.0f), float(b) * (1.0f / 255.0f), a);
}

/// The value of a texture slot at the mesh's coordinates `uv`. rgb is decoded where the slot is sRGB.
FN vec4 sample_texture(IN(TextureSlot) slot, vec2 uv) {
    uint mode_u = (slot.flags >> TEXTURE_WRAP_U_SHIFT) & 3u;
    uint mode_v = (slot.flags >> TEXTURE_WRAP_V_SHIFT) & 3u;
    bool srgb = (slot.flags & TEXTURE_SRGB) != 0u;
    float u = wrapped_coordinate(dot(slot.u_row, vec3(uv.x, uv.y, 1.0f)), mode_u) * float(slot.width);
    float v = wrapped_coordinate(dot(slot.v_row, vec3(uv.x, uv.y, 1.0f)), mode_v) * float(slot.height);
    if ((slot.flags & TEXTURE_NEAREST) != 0u) {
        uint x = wrapped_texel(int(floor(u)), slot.width, mode_u);
        uint y = wrapped_texel(int(floor(v)), slot.height, mode_v);
        return texel_fetch(slot.first_texel, y * slot.width + x, srgb);
    }
    float left = floor(u - 0.5f);
    float top = floor(v - 0.5f);
    float s = u - 0.5f - left;
    float t = v - 0.5f - top;
    uint x0 = wrapped_texel(int(left), slot.width, mode_u);
    uint x1 = wrapped_texel(int(left) + 1, slot.width, mode_u);
    uint y0 = wrapped_texel(int(top), slot.height, mode_v) * slot.width;
    uint y1 = wrapped_texel(int(top) + 1, slot.height, mode_v) * slot.width;
    vec4 a = texel_fetch(slot.first_texel, y0 + x0, srgb);
    vec4 b = texel_fetch(slot.first_texel, y0 + x1, srgb);
    vec4 c = texel_fetch(slot.first_texel, y1 + x0, srgb);
    vec4 d = texel_fetch(slot.first_texel, y1 + x1, srgb);
    vec4 upper = a + s * (b - a);  // in this form equal texels interpolate to exactly their value
    vec4 lower = c + s * (d - c);
    return upper + t * (lower - upper);
}

/// A point on a mesh: enough to fetch any attribute there.
struct MeshPoint {
    Geometry geometry;
    uvec3 triangle;     // vertex indices within the geometry
    vec2 barycentrics;  // of the second and third vertex
};

FN MeshPoint mesh_point(IN(Geometry) geometry, uint primitive, vec2 barycentrics) {
    MeshPoint p;
    p.geometry = geometry;
    p.triangle = load_triangles(geometry.first_triangle + primitive);
    p.barycentrics = barycentrics;
    return p;
}

// Interpolates an attribute from its values at the corners. An attribute that is equal at all three corners keeps
// exactly its value. Three weights that sum to just below 1 would open holes where alpha equals its cutoff.
FN vec2 interpolate(IN(MeshPoint) p, vec2 a, vec2 b, vec2 c) {
    return a + p.barycentrics.x * (b - a) + p.barycentrics.y * (c - a);
}

FN vec3 interpolate(IN(MeshPoint) p, vec3 a, vec3 b, vec3 c) {
    return a + p.barycentrics.x * (b - a) + p.barycentrics.y * (c - a);
}

FN vec4 interpolate(IN(MeshPoint) p, vec4 a, vec4 b, vec4 c) {
    vec2 uv = p.barycentrics;
    return MUTANT(CONSTANTS_DRIFT, a + uv.x * (b - a) + uv.y * (c - a), (1.0f - uv.x - uv.y) * a + uv.x * b + uv.y * c);
}

FN vec2 mesh_uv(IN(MeshPoint) p, uint first_uv) {
    if (first_uv == NONE) {
        return vec2(0.0f, 0.0f);
    }
    vec2 a = load_uvs(first_uv + p.triangle.x);
    vec2 b = load_uvs(first_uv + p.triangle.y);
    vec2 c = load_uvs(first_uv + p.triangle.z);
    return interpolate(p, a, b, c);
}

/// The value of a slot at a point of a mesh; white where the slot has no texture.
FN vec4 slot_value(uint slot_index, IN(MeshPoint) p) {
    if (!feature(FEATURE_TEXTURES) || slot_index == NONE) {
        return vec4(1.0f, 1.0f, 1.0f, 1.0f);
    }
    LOCAL(TextureSlot) slot = load_texture_slots(slot_index);
    bool second = feature(FEATURE_SECOND_UV) && (slot.flags & TEXTURE_UV_1) != 0u;
    return sample_texture(slot, mesh_uv(p, second ? p.geometry.first_uv_1 : p.geometry.first_uv_0));
}

/// Base colour: factor times texture times vertex colour. The fourth component is alpha, before alphaMode is applied.
FN vec4 base_color(IN(Material) material, IN(MeshPoint) p) {
    vec4 color = material.base_color * slot_value(material.base_color_slot, p);
    if (feature(FEATURE_VERTEX_COLORS) && p.geometry.first_color != NONE) {
        vec4 a = load_colors(p.geometry.first_color + p.triangle.x);
        vec4 b = load_colors(p.geometry.first_color + p.triangle.y);
        vec4 c = load_colors(p.geometry.first_color + p.triangle.z);
        color = color * interpolate(p, a, b, c);
    }
    return color;
}

/// Opacity by alphaMode: 0 or 1 under MASK, alpha under BLEND.
FN float opacity(IN(Material) material, float alpha) {
    if ((material.flags & MATERIAL_ALPHA_MASK) != 0u) {
        return alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
    }
    if ((material.flags & MATERIAL_ALPHA_BLEND) != 0u) {
        return min(max(alpha, 0.0f), 1.0f);
    }
    return 1.0f;
}

#endif
