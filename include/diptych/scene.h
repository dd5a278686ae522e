// The scene: what is rendered.
//
// Conventions are glTF 2.0's: right-handed, metres, +Y up. A camera and a light look along their local -Z. Angles are
// radians, but those of Sun are degrees. Colours are linear Rec.709. Texture coordinates start at the upper left corner
// of an image.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "diptych/export.h"

DIPTYCH_BEGIN

using Vec2 = std::array<float, 2>;
using Vec3 = std::array<float, 3>;
using Vec4 = std::array<float, 4>;
using Point = std::array<double, 3>;
using Matrix = std::array<double, 16>;  // 4 x 4, column-major, as glTF stores it

inline constexpr Matrix identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// The index of nothing.
inline constexpr int none = -1;

/// Where a material reads a texture: (u', v') = (u_row, v_row) · (u, v, 1), as KHR_texture_transform has it.
struct TextureSlot {
    int texture = none;  // of Scene::add_texture, or of the file
    int uv_set = 0;      // 0 or 1
    Vec3 u_row{1, 0, 0};
    Vec3 v_row{0, 1, 0};

    bool operator==(const TextureSlot&) const = default;
};

enum class AlphaMode { opaque, mask, blend };

/// glTF 2.0 metallic-roughness with KHR_materials_ior, _specular, _emissive_strength and _unlit. Factors multiply
/// textures.
struct Material {
    std::string name;
    Vec4 base_color{1, 1, 1, 1};
    float metallic = 1;   // 0 to 1
    float roughness = 1;  // 0 to 1; perceptual: the microfacet alpha is its square
    float normal_scale = 1;
    Vec3 emission{0, 0, 0};  // radiance, W/(sr m²)
    float ior = 1.5F;        // 0, or at least 1
    float specular = 1;      // 0 to 1
    Vec3 specular_color{1, 1, 1};
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5F;
    bool double_sided = false;               // also: emits from both sides
    bool unlit = false;                      // shows base_color and scatters nothing
    TextureSlot base_color_texture;          // rgb sRGB, a linear
    TextureSlot metallic_roughness_texture;  // g roughness, b metallic
    TextureSlot normal_texture;              // tangent space, +Y up
    TextureSlot emission_texture;            // sRGB
    TextureSlot specular_texture;            // a
    TextureSlot specular_color_texture;      // rgb sRGB

    bool operator==(const Material&) const = default;
};

struct Camera {
    std::string name;
    Matrix camera_to_world = identity;  // rigid
    bool orthographic = false;
    double vertical_fov = 0.785;     // perspective; 0 to pi, both excluded
    double orthographic_height = 1;  // orthographic: metres, of the whole view
    double lens_radius = 0;          // metres; 0 is a pinhole
    double focus_distance = 1;       // metres along -Z
    int node = none;                 // that it hangs in: see Node

    bool operator==(const Camera&) const = default;
};

/// A perspective camera at `eye` that looks at `target`. Throws Error where they are one point, or where `up` is
/// parallel to the line between them.
DIPTYCH_EXPORT Camera look_at(const Point& eye, const Point& target, const Point& up = {0, 1, 0},
                              double vertical_fov = 0.785);

enum class LightKind { point, spot, directional };

/// KHR_lights_punctual, without a range.
struct Light {
    std::string name;
    LightKind kind = LightKind::point;
    Matrix light_to_world = identity;
    Vec3 intensity{1, 1, 1};                // point, spot: W/sr; directional: W/m²
    double inner_cone = 0;                  // spot
    double outer_cone = 0.785398163397448;  // spot; greater than inner_cone, at most pi/2
    int node = none;                        // that it hangs in: see Node

    bool operator==(const Light&) const = default;
};

/// A directional light said as a sun is: add it to Scene::lights by Scene::add.
struct Sun {
    double azimuth = 0;     // degrees from -Z, clockwise seen from above
    double elevation = 45;  // degrees above the horizon
    double irradiance = 1;  // W/m², of a surface that faces it
};

/// An equirectangular map: width * height texels from the top left, linear radiance. Its centre looks along -Z.
struct EnvironmentMap {
    int width = 0;
    int height = 0;
    std::vector<Vec3> texels;
};

/// Light from infinity: radiance `scale`, times the map where there is one. Black by default.
struct Environment {
    Vec3 scale{0, 0, 0};
    double rotation = 0;  // counter-clockwise about +Y, seen from above
    std::shared_ptr<const EnvironmentMap> map;

    bool operator==(const Environment&) const = default;
};

/// Reads a map from an .hdr or .exr file, at scale 1. The file may ask for `memory_limit` bytes; 0 is a quarter of the
/// machine's memory. Throws Error.
DIPTYCH_EXPORT Environment load_environment(const std::string& path, std::uint64_t memory_limit = 0);

/// A mesh at its place.
struct Instance {
    std::string name;
    int mesh = none;
    Matrix object_to_world = identity;
    int node = none;  // that it hangs in: see Node

    bool operator==(const Instance&) const = default;
};

/// A node of the file's tree, at rest. Its name and its matrix may be edited; an edit of the rest is refused.
///
/// An edited matrix moves all that hangs in the node and below it: at the next render, the matrices of these instances,
/// cameras and lights are the product of their nodes' matrices (a camera's and a light's without scale). The matrix of
/// an instance, camera or light itself may be edited too. It wins over the nodes, whether they are edited as well or
/// not: the object then hangs in no node, and `node` is none from the next render on. An object whose `node` is set
/// hangs there if its matrix is the one that the node gives. A skinned mesh hangs in no node: its joints placed it when
/// it was loaded.
///
/// An animation that plays sets a node's translation, rotation or scale at each moment that a session poses, in place
/// of that part of the matrix. The parts that it does not set, and a scene at rest, are the matrix's. The matrix of
/// such a node has to be a product of the three.
struct Node {
    std::string name;
    Matrix node_to_parent = identity;  // affine
    int parent = none;
    std::vector<int> children;  // ascending
    bool animated = false;  // an animation that plays sets it

    bool operator==(const Node&) const = default;
};

/// What hangs in a node itself, not below it: indices into the scene's tables.
struct NodeContent {
    std::vector<int> instances;
    std::vector<int> cameras;
    std::vector<int> lights;
};

/// Triangles of one material, which Scene::add_mesh copies. Spans may be empty where it says so.
struct MeshData {
    std::string name;
    std::span<const Vec3> positions;
    std::span<const std::array<std::uint32_t, 3>> triangles;  // indices into positions; counter-clockwise is the front
    std::span<const Vec3> normals;                            // as long as positions, or empty: flat shading
    std::span<const Vec2> uvs;                                // as long as positions, or empty
    int material = none;                                      // none: a default material is added
};

// The implementation's.
struct Impl;
struct SceneData;

/// A handle: copies of it are the same scene, which lives as long as the last of them, or of the sessions that render
/// it. What its references give may be edited at any time between calls of sessions; a session sees edits at its next
/// render, pose, change of camera or settings, or replay, and throws there what is out of range. Materials may not be
/// removed, nor lights of a scene with animations: other parts refer to them by index. Not to be edited by two threads
/// at once.
class DIPTYCH_EXPORT Scene {
public:
    /// Empty, and black.
    Scene();

    std::vector<Material>& materials();
    std::vector<Camera>& cameras();  // where there is none, a session adds one that frames the scene as it is then
    std::vector<Light>& lights();
    std::vector<Instance>& instances();
    Environment& environment();

    /// All nodes of the file, with the file's indices; none of a scene that was built. Nodes can be neither added nor
    /// removed. The table is made at the first call, which counts as an edit where threads share the scene.
    std::vector<Node>& nodes();

    /// What names this node now. Throws Error where there is no such node.
    NodeContent content_of(int node) const;

    /// The first of that name; valid until the table grows. Throws Error with the names that there are.
    Material& material(std::string_view name);
    Camera& camera(std::string_view name);
    Light& light(std::string_view name);
    Instance& instance(std::string_view name);
    Node& node(std::string_view name);

    /// The light that the sun becomes, at the end of lights().
    Light& add(const Sun& sun);

    /// Adds a mesh, and one instance of it at `object_to_world`. Returns the mesh's index. Throws Error, and adds
    /// nothing, where an array is not as long as `positions`, an index is out of range or a number is not finite.
    int add_mesh(const MeshData& mesh, const Matrix& object_to_world = identity);

    /// Adds an image of 8-bit RGBA, width * height * 4 bytes from the top left, as a texture that repeats and is
    /// filtered. Returns its index. Throws Error where the size is wrong.
    int add_texture(int width, int height, std::span<const std::uint8_t> rgba, const std::string& name = "");

    const std::string& name() const;  // the file's path; empty for a scene that was built
    std::size_t mesh_count() const;
    std::size_t triangle_count() const;           // over all instances
    std::vector<std::string> animations() const;  // names, in the file's order
    double duration() const;                      // seconds to the last key of the animations that play

    /// A scene of its own with the same content.
    Scene copy() const;

private:
    friend struct Impl;
    std::shared_ptr<SceneData> data_;
};

struct LoadOptions {
    std::vector<std::string> ignore_extensions;  // glTF extensions that the file requires and that are done without
    bool strict = false;                         // whatever would be a warning throws
    bool allow_external = false;                 // read what the file names outside its folder too
    std::uint64_t memory_limit = 0;              // bytes that the file may ask for; 0: a quarter of the memory
    std::string animation;                       // name or index of the one that plays; empty: all of them
    bool complete = true;  // add a camera where there is none, a neutral sky where it would be black
    std::function<void(const std::string& line)> warnings;
};

/// Loads a .gltf or .glb file. Throws Error.
DIPTYCH_EXPORT Scene load(const std::string& path, const LoadOptions& options = {});

DIPTYCH_END
