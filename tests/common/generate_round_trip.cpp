// What is written is what is read: write_gltf against load_gltf.
#include "catch.h"
#include "generate_fixture.h"
#include "gltf/import.h"
#include "gltf/write.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

using namespace diptych::core;
using namespace diptych::core::generate_tests;

namespace {

template <typename Matrix>
bool are_close(const Matrix& a, const Matrix& b, double tolerance) {
    for (int i = 0; i < a.length(); ++i) {
        for (int k = 0; k < a[i].length(); ++k) {
            if (!(std::abs(a[i][k] - b[i][k]) <= tolerance)) {
                return false;
            }
        }
    }
    return true;
}

bool are_close(const glm::vec3& a, const glm::vec3& b, float tolerance) {
    return glm::length(a - b) <= tolerance;
}

void check_slot(const Scene& a, const TextureSlot& slot_a, const Scene& b, const TextureSlot& slot_b) {
    REQUIRE((slot_a.texture == none) == (slot_b.texture == none));
    if (slot_a.texture == none) {
        return;
    }
    CHECK(slot_a.uv_set == slot_b.uv_set);
    CHECK(are_close(slot_a.u_row, slot_b.u_row, 1e-5F));
    CHECK(are_close(slot_a.v_row, slot_b.v_row, 1e-5F));
    const Texture& texture_a = a.textures.at(std::size_t(slot_a.texture));
    const Texture& texture_b = b.textures.at(std::size_t(slot_b.texture));
    CHECK(texture_a.wrap_u == texture_b.wrap_u);
    CHECK(texture_a.wrap_v == texture_b.wrap_v);
    CHECK(texture_a.filter == texture_b.filter);
    const TextureImage& image_a = a.images.at(std::size_t(texture_a.image));
    const TextureImage& image_b = b.images.at(std::size_t(texture_b.image));
    CHECK(image_a.width == image_b.width);
    CHECK(image_a.rgba == image_b.rgba);
}

void check_material(const Scene& a, const Material& m, const Scene& b, const Material& n) {
    INFO("material " << m.name);
    CHECK(m.name == n.name);
    CHECK(m.base_color == n.base_color);
    CHECK(m.metallic == n.metallic);
    CHECK(m.roughness == n.roughness);
    CHECK(m.normal_scale == n.normal_scale);
    CHECK(are_close(m.emission, n.emission, 1e-6F * glm::length(m.emission)));
    CHECK(m.ior == n.ior);
    CHECK(m.specular == n.specular);
    CHECK(m.specular_color == n.specular_color);
    CHECK(m.alpha_mode == n.alpha_mode);
    CHECK(m.alpha_cutoff == n.alpha_cutoff);
    CHECK(m.double_sided == n.double_sided);
    CHECK(m.unlit == n.unlit);
    check_slot(a, m.base_color_texture, b, n.base_color_texture);
    check_slot(a, m.metallic_roughness_texture, b, n.metallic_roughness_texture);
    check_slot(a, m.normal_texture, b, n.normal_texture);
    check_slot(a, m.emission_texture, b, n.emission_texture);
    check_slot(a, m.specular_texture, b, n.specular_texture);
    check_slot(a, m.specular_color_texture, b, n.specular_color_texture);
}

/// Equal but for the order of the tables.
void check_scene(const Scene& a, const Scene& b) {
    CHECK(b.warnings.empty());
    REQUIRE(a.instances.size() == b.instances.size());
    for (std::size_t i = 0; i < a.instances.size(); ++i) {
        const Instance &p = a.instances[i], &q = b.instances[i];
        INFO("instance " << i << " " << p.name);
        CHECK(are_close(p.object_to_world, q.object_to_world, 1e-12));
        const Mesh &mesh = a.meshes.at(std::size_t(p.mesh)), &other = b.meshes.at(std::size_t(q.mesh));
        REQUIRE(mesh.primitives.size() == other.primitives.size());
        for (std::size_t k = 0; k < mesh.primitives.size(); ++k) {
            const Primitive &s = mesh.primitives[k], &t = other.primitives[k];
            const bool same = s.positions == t.positions && s.triangles == t.triangles && s.tangents == t.tangents &&
                              s.uvs == t.uvs && s.colors == t.colors && s.normals.size() == t.normals.size();
            CHECK(same);
            bool normals_agree = same;  // the import makes them unit vectors again
            for (std::size_t n = 0; same && n < s.normals.size(); ++n) {
                normals_agree = normals_agree && are_close(s.normals[n], t.normals[n], 1e-6F);
            }
            CHECK(normals_agree);
            check_material(a, a.materials.at(std::size_t(s.material)), b, b.materials.at(std::size_t(t.material)));
        }
    }
    REQUIRE(a.cameras.size() == b.cameras.size());
    for (std::size_t i = 0; i < a.cameras.size(); ++i) {
        const Camera &p = a.cameras[i], &q = b.cameras[i];
        CHECK(p.name == q.name);
        CHECK(are_close(p.camera_to_world, q.camera_to_world, 1e-12));
        CHECK(p.orthographic == q.orthographic);
        if (!p.orthographic) {
            CHECK(p.vertical_fov == q.vertical_fov);
        } else {
            CHECK(p.orthographic_height == q.orthographic_height);
        }
    }
    REQUIRE(a.lights.size() == b.lights.size());
    for (std::size_t i = 0; i < a.lights.size(); ++i) {
        const PunctualLight &p = a.lights[i], &q = b.lights[i];
        CHECK(p.type == q.type);
        CHECK(are_close(p.intensity, q.intensity, 1e-5F * glm::length(p.intensity)));
        CHECK(are_close(p.light_to_world, q.light_to_world, 1e-12));
        if (p.type == PunctualType::spot) {
            CHECK(std::abs(p.inner_cone - q.inner_cone) < 1e-12);
            CHECK(std::abs(p.outer_cone - q.outer_cone) < 1e-12);
        }
    }
}

TextureImage noise_image(const std::string& name, int width, int height, bool with_alpha) {
    TextureImage out;
    out.name = name;
    out.width = width;
    out.height = height;
    std::uint32_t state = 7;
    for (int i = 0; i < 4 * width * height; ++i) {
        state = state * 1664525U + 1013904223U;
        // Half noise, half runs, so that both literals and matches of the compressor are met.
        const bool is_run = (i / 4) % 97 > 40;
        out.rgba.push_back(i % 4 == 3 && !with_alpha ? 255
                           : is_run                  ? std::uint8_t(i / 1024)
                                                     : std::uint8_t(state >> 24U));
    }
    return out;
}

TextureSlot slot_of(int texture, int uv_set) {
    TextureSlot out;
    out.texture = texture;
    out.uv_set = uv_set;
    return out;
}

/// Everything that the format holds, at values that no default hides.
Scene full_scene() {
    Scene scene;
    scene.name = "full";
    scene.images = {noise_image("a name", 61, 200, true), noise_image("", 16, 1, false)};
    scene.textures = {{"", 0, Wrap::clamp, Wrap::mirror, Filter::nearest},
                      {"second", 1, Wrap::repeat, Wrap::repeat, Filter::linear}};
    Material m;
    m.name = "everything";
    m.base_color = {0.1F, 0.2F, 0.3F, 0.4F};
    m.metallic = 0.7F;
    m.roughness = 0.3F;
    m.normal_scale = 0.8F;
    m.emission = {5, 0.3F, 123.25F};
    m.ior = 1.33F;
    m.specular = 0.6F;
    m.specular_color = {0.9F, 0.8F, 0.7F};
    m.alpha_mode = AlphaMode::mask;
    m.alpha_cutoff = 0.25F;
    m.double_sided = true;
    m.base_color_texture = slot_of(0, 1);
    const float c = std::cos(0.7F), s = std::sin(0.7F);
    m.base_color_texture.u_row = {2 * c, 3 * s, 0.25F};
    m.base_color_texture.v_row = {-2 * s, 3 * c, -0.5F};
    m.metallic_roughness_texture = slot_of(1, 0);
    m.normal_texture = slot_of(1, 0);
    m.emission_texture = slot_of(0, 0);
    m.specular_texture = slot_of(0, 0);
    m.specular_color_texture = slot_of(1, 1);
    Material plain;
    plain.name = "plain";
    Material bright;
    bright.name = "bright";
    bright.unlit = true;
    bright.alpha_mode = AlphaMode::blend;
    bright.emission = {0.5F, 0.25F, 0};
    scene.materials = {m, plain, bright};

    Primitive p;
    p.material = 0;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.125F}};
    p.normals.assign(4, {0, 0, 1});
    p.tangents.assign(4, {1, 0, 0, -1});
    p.uvs = {std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}, {1, 1}}, {{0.1F, 0}, {1, 0.2F}, {0, 3}, {-1, 1}}};
    p.colors = {{1, 0.5F, 0.25F, 1}, {0, 1, 0, 1}, {0, 0, 1, 0.5F}, {1, 1, 1, 1}};
    p.triangles = {{0, 1, 2}, {1, 3, 2}};
    Primitive q;
    q.material = 1;
    q.positions = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    q.triangles = {{0, 1, 2}};
    Primitive r = q;
    r.material = 2;
    scene.meshes = {{"two parts", {p, q}}, {"one", {r}}};
    const glm::dmat4 turned =
        glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(1e5, 2, 3)), 0.5, glm::dvec3(0, 0.6, 0.8));
    scene.instances = {
        {"first", 0, glm::dmat4(1)},
        {"turned", 0, turned},
        {"stretched", 1, glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(1, 2, 3)), glm::dvec3(1, 2, 0.5))},
        {"mirrored", 1, glm::scale(turned, glm::dvec3(-1, 1, 3))}};
    Camera wide;
    wide.name = "wide";
    wide.vertical_fov = 1.25;
    wide.aspect = 1.5;
    wide.camera_to_world = turned;
    Camera flat;
    flat.name = "flat";
    flat.orthographic = true;
    flat.orthographic_height = 3.5;
    scene.cameras = {wide, flat};
    scene.lights = {{"bulb", PunctualType::point, turned, {10, 20, 5}, 0, 0.7853981633974483},
                    {"sun", PunctualType::directional, turned, {1, 0.5F, 0.25F}, 0, 0.7853981633974483},
                    {"torch", PunctualType::spot, turned, {100, 50, 0}, 0.25, 0.5}};
    return scene;
}

}  // namespace

TEST_CASE("a generated scene survives being written and read", "[generate]") {
    const TemporaryFolder folder;
    for (const SceneGenerator& generator : scene_generators()) {
        for (const char* extension : {".gltf", ".glb"}) {
            INFO(generator.name << extension);
            const Scene scene = generate_scene(generator.name).scene;
            const auto path = folder.path() / (generator.name + std::string(extension));
            write_gltf(scene, path);
            check_scene(scene, load_gltf(path));
        }
    }
}

TEST_CASE("every field that glTF holds survives being written and read", "[generate]") {
    const TemporaryFolder folder;
    for (const char* file : {"with space.gltf", "full.glb"}) {
        INFO(file);
        const Scene scene = full_scene();
        write_gltf(scene, folder.path() / file);
        check_scene(scene, load_gltf(folder.path() / file));
    }
}

TEST_CASE("primitives of more than 65535 vertices survive being written and read", "[generate]") {
    const TemporaryFolder folder;
    for (const std::size_t vertices : {65535U, 65536U, 70000U}) {
        INFO(vertices);
        Scene scene;
        scene.name = "large";
        scene.materials.emplace_back();
        Primitive primitive;
        primitive.material = 0;
        for (std::size_t i = 0; i < vertices; ++i) {
            primitive.positions.push_back({float(i), float(i % 3), float(i * i % 101)});
        }
        for (std::uint32_t i = 0; i + 2 < vertices; ++i) {
            primitive.triangles.push_back({i, i + 1, i + 2});
        }
        scene.meshes = {{"large", {primitive}}};
        scene.instances = {{"large", 0, glm::dmat4(1)}};
        write_gltf(scene, folder.path() / "large.glb");
        const Scene back = load_gltf(folder.path() / "large.glb");
        const Primitive& read = back.meshes.at(0).primitives.at(0);
        CHECK(read.positions == primitive.positions);
        CHECK(read.triangles == primitive.triangles);
    }
}
