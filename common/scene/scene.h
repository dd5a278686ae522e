// The logical scene: what a file says, before anything is packed for a backend.
//
// Conventions are glTF 2.0's: right-handed, metres, +Y up; a camera and a light look along their local -Z;
// counter-clockwise is the front; texture coordinates start at the upper left corner of an image. Transforms are
// double, so that a scene far from the origin loses nothing before it is rebased.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/animation.h"
#include "scene/warnings.h"

namespace diptych::core {

/// What Environment::kind says; stands before the constant `none`, which its enumerator would shadow otherwise.
enum class EnvironmentKind { none, constant, map };

/// Index of nothing, in every table of the scene.
inline constexpr int none = -1;

/// One image as stored: 8-bit RGBA, row 0 at the top. Whether a channel is sRGB is for the slot that uses it to say.
struct TextureImage {
    std::string name;
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;  // width * height * 4
};

enum class Wrap { repeat, clamp, mirror };
enum class Filter { nearest, linear };

struct Texture {
    std::string name;
    int image = none;
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    Filter filter = Filter::linear;
};

/// Where a material reads a texture: the UV set and the affine map of KHR_texture_transform, (u', v') = (u_row,
/// v_row)·(u, v, 1).
struct TextureSlot {
    int texture = none;
    int uv_set = 0;  // 0 or 1
    glm::vec3 u_row{1, 0, 0};
    glm::vec3 v_row{0, 1, 0};
};

enum class AlphaMode { opaque, mask, blend };

/// The two numbers behind Material::emission, where an animation changes either.
struct MovingEmission {
    glm::vec3 factor{0};
    float strength = 1;
};

/// glTF 2.0 metallic-roughness, with KHR_materials_ior, _specular, _emissive_strength and _unlit. Colours are linear
/// Rec.709.
struct Material {
    std::string name;
    glm::vec4 base_color{1};
    float metallic = 1;
    float roughness = 1;  // perceptual; the microfacet alpha is its square
    float normal_scale = 1;
    glm::vec3 emission{0};  // emitted radiance, W/(sr m^2): factor times strength
    float ior = 1.5F;
    float specular = 1;
    glm::vec3 specular_color{1};
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5F;
    bool double_sided = false;                        // also: emits from both sides
    bool unlit = false;                               // emits base_color, scatters nothing
    TextureSlot base_color_texture;                   // rgb sRGB, a linear
    TextureSlot metallic_roughness_texture;           // g roughness, b metallic; linear
    TextureSlot normal_texture;                       // tangent space, +Y up; linear
    TextureSlot emission_texture;                     // sRGB
    TextureSlot specular_texture;                     // a; linear
    TextureSlot specular_color_texture;               // rgb sRGB
    std::optional<MovingEmission> moving_emission{};  // present: counts as emissive at every moment, dark ones included
};

/// All slots of a material.
inline constexpr std::array<TextureSlot Material::*, 6> texture_slots = {
    &Material::base_color_texture, &Material::metallic_roughness_texture, &Material::normal_texture,
    &Material::emission_texture,   &Material::specular_texture,           &Material::specular_color_texture};

/// Triangles of one material. Attribute arrays are either empty or as long as `positions`.
struct Primitive {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;   // empty: flat shading by the geometric normal
    std::vector<glm::vec4> tangents;  // w is the bitangent's sign; present only where the material has a normal map
    std::array<std::vector<glm::vec2>, 2> uvs;
    std::vector<glm::vec4> colors;  // linear, multiplies base_color
    std::vector<glm::uvec3> triangles;
    int material = none;  // always valid after import: a default material is appended where the file names none
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
};

/// A mesh placed in the world.
struct Instance {
    std::string name;
    int mesh = none;
    glm::dmat4 object_to_world{1};
    int node = none;  // that it hangs in; none where nothing moves it
};

struct Lens {
    double radius = 0;          // metres; 0 is a pinhole
    double focus_distance = 1;  // metres along -Z

    bool operator==(const Lens&) const = default;
};

struct Camera {
    std::string name;
    glm::dmat4 camera_to_world{1};  // rigid: the import removes scale
    bool orthographic = false;
    double vertical_fov = 0.785;     // radians; perspective only
    double orthographic_height = 1;  // full height of the view, metres; orthographic only
    std::optional<double> aspect;    // width / height the file asks for; the render's own size wins
    Lens lens;
    int node = none;                 // that it hangs in; none where nothing moves it
};

enum class PunctualType { point, spot, directional };

/// KHR_lights_punctual. `range` is a culling hint there, and physically light has none: it is ignored.
struct PunctualLight {
    std::string name;
    PunctualType type = PunctualType::point;
    glm::dmat4 light_to_world{1};
    glm::vec3 intensity{1};  // point and spot: W/sr; directional: W/m^2
    double inner_cone = 0;   // radians
    double outer_cone = 0.7853981633974483;
    int node = none;                          // that it hangs in; none where nothing moves it
    std::optional<glm::vec3> moving_color{};  // present where an animation sets the intensity: what it multiplies
};

/// Light from infinity. Radiance is `scale` times 1 (constant) or times the map, an equirectangular image whose centre
/// looks along -Z before `rotation` (radians, counter-clockwise about +Y seen from above) and whose top row is +Y.
struct Environment {
    using Kind = EnvironmentKind;
    Kind kind = Kind::none;
    glm::vec3 scale{1};
    double rotation = 0;
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> texels;  // width * height, linear radiance
};

struct Scene {
    std::string name;  // the file, for messages
    std::vector<TextureImage> images;
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Camera> cameras;
    std::vector<PunctualLight> lights;
    Environment environment;
    std::vector<Node> nodes;  // only those that move or carry what moves, parents first
    std::vector<Animation> animations;  // as many as the file has, with the same indices
    Warnings warnings;                  // of the import and of what was added to the scene since
};

}  // namespace diptych::core
