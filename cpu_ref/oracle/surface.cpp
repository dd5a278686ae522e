#include "oracle/surface.h"

#include "oracle/texture.h"

namespace diptych::core::oracle {

namespace {

/// The part of a tangent across the normal that still tells a direction, of the tangent's length.
constexpr double least_part_across = 1e-4;

dvec4 base_color(const World& world, const Triangle& triangle, dvec2 uv) {
    const Material& m = *triangle.material;
    const dvec4 vertex =
        triangle.primitive->colors.empty() ? dvec4(1) : interpolate(triangle.primitive->colors, triangle, uv);
    return dvec4(m.base_color) * vertex *
           sample_texture(*world.scene, m.base_color_texture, triangle, uv, Encoding::srgb);
}

Bsdf make_bsdf(const World& world, Distribution model, const Triangle& triangle, dvec2 uv, const dvec3& color) {
    const Material& m = *triangle.material;
    const Scene& scene = *world.scene;
    const dvec4 rough = sample_texture(scene, m.metallic_roughness_texture, triangle, uv, Encoding::linear);
    const double metallic = glm::clamp(double(m.metallic) * rough.b, 0.0, 1.0);
    const double roughness = glm::clamp(double(m.roughness) * rough.g, 0.0, 1.0);
    const double specular =
        double(m.specular) * sample_texture(scene, m.specular_texture, triangle, uv, Encoding::linear).a;
    const dvec3 tint =
        dvec3(m.specular_color) * dvec3(sample_texture(scene, m.specular_color_texture, triangle, uv, Encoding::srgb));
    const double ior = m.ior;
    const double dielectric = ior == 0 ? 1 : (ior - 1) * (ior - 1) / ((ior + 1) * (ior + 1));
    Bsdf bsdf;
    bsdf.model = model;
    bsdf.alpha = roughness * roughness;
    bsdf.diffuse = color * (1 - metallic);
    bsdf.f0 = mix(specular * min(dielectric * tint, dvec3(1)), color, metallic);
    bsdf.f90 = glm::mix(specular, 1.0, metallic);
    return bsdf;
}

/// The mesh's normal, not yet turned to the viewer; the front's where there is none.
dvec3 mesh_normal(const World& world, const Triangle& triangle, dvec2 uv) {
    if (triangle.primitive->normals.empty()) {
        return triangle.front;
    }
    const dvec3 n =
        world.frames[triangle.frame].normals * interpolate(triangle.primitive->normals, triangle, uv);
    const double size = length(n);
    return size > 0 ? n / size : triangle.front;
}

/// The normal map's normal in the world, for the mesh's normal `n`; `n` itself where there is no map.
dvec3 mapped_normal(const World& world, const Triangle& triangle, dvec2 uv, const dvec3& n) {
    const Material& m = *triangle.material;
    if (m.normal_texture.texture == none || triangle.primitive->tangents.empty()) {
        return n;
    }
    const dvec4 tangent = interpolate(triangle.primitive->tangents, triangle, uv);
    const Frame& frame = world.frames[triangle.frame];
    const dvec3 along = frame.linear * dvec3(tangent);
    const dvec3 across = along - dot(along, n) * n;
    if (!(length(across) > least_part_across * length(along))) {
        return n;
    }
    const dvec3 t = normalize(across);
    const dvec3 b = cross(n, t) * ((tangent.w < 0) != frame.mirrored ? -1.0 : 1.0);
    const dvec4 texel = sample_texture(*world.scene, m.normal_texture, triangle, uv, Encoding::linear);
    const dvec3 local = (2.0 * dvec3(texel) - 1.0) * dvec3(m.normal_scale, m.normal_scale, 1);
    if (local.x == 0 && local.y == 0 && local.z > 0) {
        return n;  // exactly: a rounded n would scatter as a mapped normal does
    }
    const dvec3 mapped = local.x * t + local.y * b + local.z * n;
    const double size = length(mapped);
    return size > 0 ? mapped / size : n;
}

}  // namespace

bool emits(const Material& material) {
    return material.unlit || material.emission != glm::vec3(0);
}

dvec3 emitted(const World& world, const Triangle& triangle, dvec2 uv, const dvec3& o) {
    const Material& m = *triangle.material;
    if (m.unlit) {
        return dvec3(base_color(world, triangle, uv));
    }
    if (!emits(m) || (!m.double_sided && !(dot(o, triangle.front) > 0))) {
        return dvec3(0);
    }
    return dvec3(m.emission) * dvec3(sample_texture(*world.scene, m.emission_texture, triangle, uv, Encoding::srgb));
}

double coverage(const World& world, const Triangle& triangle, dvec2 uv) {
    const Material& m = *triangle.material;
    if (m.alpha_mode == AlphaMode::opaque) {
        return 1;
    }
    const double a = base_color(world, triangle, uv).a;
    if (m.alpha_mode == AlphaMode::mask) {
        // Both in single precision: a texel's 128/255 equals a cutoff that the file gives as 0.50196078.
        return float(a) >= m.alpha_cutoff ? 1 : 0;
    }
    return glm::clamp(a, 0.0, 1.0);
}

Surface make_surface(const World& world, Distribution model, NormalMaps maps, const Hit& hit, const dvec3& o) {
    const Triangle& triangle = world.triangles[hit.triangle];
    const dvec2 uv = hit.barycentrics;
    Surface surface;
    surface.position = point_on(triangle, uv);
    surface.o = o;
    surface.normal = dot(o, triangle.front) < 0 ? -triangle.front : triangle.front;
    surface.base_color = dvec3(base_color(world, triangle, uv));
    surface.emission = emitted(world, triangle, uv, o);
    surface.scatters = !triangle.material->unlit;
    surface.bsdf = make_bsdf(world, model, triangle, uv, surface.base_color);
    const dvec3 n = mesh_normal(world, triangle, uv);
    const dvec3 p = mapped_normal(world, triangle, uv, n);
    const double side = dot(n, surface.normal) < 0 ? -1 : 1;
    surface.normals = make_normals(maps, surface.normal, side * n, side * p, o);
    return surface;
}

}  // namespace diptych::core::oracle
