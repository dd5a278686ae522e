// Nodes, cameras, lights and materials of hand-written glTF files with known numbers.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "catch.h"
#include "gltf_fixture.h"
#include "scene/default_camera.h"
#include "gltf/import.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

bool near(glm::dvec3 a, glm::dvec3 b) {
    return glm::length(a - b) < 1e-9;
}

glm::dvec3 apply(const glm::dmat4& matrix, glm::dvec3 point) {
    return glm::dvec3(matrix * glm::dvec4(point, 1));
}

std::string triangle_meshes(GltfBuilder& builder) {
    return R"("meshes":[{"primitives":[{"attributes":{"POSITION":)" + std::to_string(builder.triangle()) + "}}]}]";
}

// One texel of (200, 100, 50) with an alpha of 64, as PNG.
const char* const one_texel =
    "data:image/"
    "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGM4kWLkAAAE9QGfhM72PAAAAABJRU5ErkJggg==";

/// A triangle of the material, for which there are seven textures by the names t0 to t6.
Scene load_material(const std::string& material, const std::string& samplers = "[{}]") {
    std::string textures;
    for (int i = 0; i < 7; ++i) {
        textures += std::string(i == 0 ? "" : ",") + R"({"source":0,"sampler":0,"name":"t)" + std::to_string(i) + "\"}";
    }
    GltfBuilder builder;
    const std::string points = std::to_string(builder.triangle());
    const std::string uvs = std::to_string(builder.floats({0, 0, 1, 0, 0, 1}, "VEC2", 3));
    return load_text(
        builder.text(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{)"
                     R"("POSITION":)" +
                     points + R"(,"TEXCOORD_0":)" + uvs + R"(,"TEXCOORD_1":)" + uvs +
                     R"(},"material":0}]}],"materials":[)" + material + R"(],"samplers":)" + samplers +
                     R"(,"textures":[)" + textures + R"(],"images":[{"uri":")" + one_texel + R"("}])"));
}

}  // namespace

TEST_CASE("node transforms compose in double, and instances share their mesh", "[gltf]") {
    GltfBuilder builder;
    const double s = std::sqrt(0.5);
    const Scene scene = load_text(builder.text(R"("scene":1,"scenes":[{"nodes":[]},{"nodes":[0]}],"nodes":[)"
                                               R"({"name":"root","translation":[100000000.125,0,0],"children":[1]},)"
                                               R"({"rotation":[0,0,)" +
                                               std::to_string(s) + "," + std::to_string(s) +
                                               R"(],"scale":[2,3,4],"children":[2,3]},)"
                                               R"({"name":"leaf","translation":[1,1,1],"mesh":0},)"
                                               R"({"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1],"mesh":0}],)" +
                                               triangle_meshes(builder)));
    REQUIRE(scene.instances.size() == 2);
    CHECK(scene.meshes.size() == 1);
    CHECK(scene.instances[0].name == "leaf");
    // (1,1,1) is scaled to (2,3,4), then turned by 90 degrees about z to (-3,2,4).
    CHECK(near(apply(scene.instances[0].object_to_world, {0, 0, 0}), {100000000.125 - 3, 2, 4}));
    CHECK(near(apply(scene.instances[1].object_to_world, {1, 0, 0}), {100000000.125, 2, 20}));
}

TEST_CASE("a mirrored scale stays in the instance", "[gltf]") {
    GltfBuilder builder;
    const Scene scene = load_text(builder.text(R"("nodes":[{"scale":[-1,2,1],"mesh":0},{"scale":[0,0,0],"mesh":0}],)" +
                                               triangle_meshes(builder)));
    REQUIRE(scene.instances.size() == 2);
    CHECK(glm::determinant(glm::dmat3(scene.instances[0].object_to_world)) == Approx(-2));
    CHECK(scene.warnings.empty());  // what the scale of 0 leaves is for the packer to say
}

TEST_CASE("cameras are rigid, whatever their nodes scale", "[gltf]") {
    const Scene scene =
        load_text(R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"scale":[2,5,-3],"children":[1,2]},)"
                  R"({"name":"main","camera":0,"translation":[1,0,0]},{"camera":1}],"cameras":[)"
                  R"({"type":"perspective","perspective":{"yfov":0.5,"aspectRatio":1.5,"znear":0.1}},)"
                  R"({"type":"orthographic","name":"flat","orthographic":{"xmag":3,"ymag":2,"znear":0,"zfar":10}}]})");
    REQUIRE(scene.cameras.size() == 2);
    const Camera& main = scene.cameras[0];
    CHECK(main.name == "main");
    CHECK(main.vertical_fov == 0.5);
    CHECK(main.aspect.value() == 1.5);
    CHECK_FALSE(main.orthographic);
    const glm::dmat3 rotation(main.camera_to_world);
    CHECK(glm::determinant(rotation) == Approx(1));
    CHECK(near(rotation * glm::dvec3(0, 0, -1), {0, 0, 1}));
    CHECK(near(rotation * glm::dvec3(0, 1, 0), {0, 1, 0}));
    CHECK(near(glm::dvec3(main.camera_to_world[3]), {2, 0, 0}));
    const Camera& flat = scene.cameras[1];
    CHECK(flat.name == "flat");
    CHECK(flat.orthographic);
    CHECK(flat.orthographic_height == 4);
    CHECK(flat.aspect.value() == 1.5);
}

TEST_CASE("punctual lights keep their units, colours and cones", "[gltf]") {
    const Scene scene = load_text(
        R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],)"
        R"("extensions":{"KHR_lights_punctual":{"lights":[)"
        R"({"type":"spot","color":[1,0.5,0],"intensity":10,"spot":{"innerConeAngle":0.25,"outerConeAngle":0.5}},)"
        R"({"type":"directional","intensity":3},{"type":"spot","spot":{}}]}},"nodes":[)"
        R"({"translation":[0,4,0],"extensions":{"KHR_lights_punctual":{"light":0}}},)"
        R"({"rotation":[-0.7071067811865476,0,0,0.7071067811865476],"extensions":{"KHR_lights_punctual":{"light":1}}},)"
        R"({"extensions":{"KHR_lights_punctual":{"light":2}}}]})");
    REQUIRE(scene.lights.size() == 3);
    CHECK(scene.lights[0].type == PunctualType::spot);
    CHECK(scene.lights[0].intensity == glm::vec3(10, 5, 0));
    CHECK(scene.lights[0].inner_cone == 0.25);
    CHECK(scene.lights[0].outer_cone == 0.5);
    CHECK(near(glm::dvec3(scene.lights[0].light_to_world[3]), {0, 4, 0}));
    CHECK(scene.lights[1].type == PunctualType::directional);
    CHECK(near(glm::dmat3(scene.lights[1].light_to_world) * glm::dvec3(0, 0, -1), {0, -1, 0}));
    CHECK(scene.lights[2].inner_cone == 0);
    CHECK(scene.lights[2].outer_cone == Approx(std::numbers::pi / 4));
}

TEST_CASE("material factors and extensions arrive", "[gltf]") {
    const Scene scene = load_material(
        R"({"name":"paint","pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],)"
        R"("metallicFactor":0.5,"roughnessFactor":0.25},)"
        R"("emissiveFactor":[1,0.5,0],"alphaMode":"MASK","alphaCutoff":0.75,"doubleSided":true,)"
        R"("normalTexture":{"index":0,"scale":2},)"
        R"("extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":20},"KHR_materials_ior":{"ior":1.33},)"
        R"("KHR_materials_specular":{"specularFactor":0.5,"specularColorFactor":[1,2,3],)"
        R"("specularTexture":{"index":0,"texCoord":1}},)"
        R"("KHR_materials_unlit":{}}})");
    const Material& m = scene.materials.at(0);
    CHECK(m.name == "paint");
    CHECK(glm::length(m.base_color - glm::vec4(.1F, .2F, .3F, .4F)) < 1e-6F);
    CHECK(m.metallic == 0.5F);
    CHECK(m.roughness == 0.25F);
    CHECK(m.emission == glm::vec3(20, 10, 0));
    CHECK(m.alpha_mode == AlphaMode::mask);
    CHECK(m.alpha_cutoff == 0.75F);
    CHECK(m.double_sided);
    CHECK(m.normal_scale == 2);
    CHECK(m.normal_texture.texture == 0);
    CHECK(m.ior == 1.33F);
    CHECK(m.specular == 0.5F);
    CHECK(m.specular_color == glm::vec3(1, 2, 3));
    CHECK(m.specular_texture.texture == 0);
    CHECK(m.specular_texture.uv_set == 1);
    CHECK(m.unlit);
    CHECK(m.base_color_texture.texture == none);
    REQUIRE(scene.images.size() == 1);
    CHECK(scene.images[0].rgba == std::vector<std::uint8_t>{200, 100, 50, 64});
}

TEST_CASE("every slot of a material reads its own texture, and none reads the occlusion", "[gltf]") {
    const Scene scene = load_material(
        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":6},"metallicRoughnessTexture":{"index":5}},)"
        R"("normalTexture":{"index":4},"emissiveTexture":{"index":3,"texCoord":1},"emissiveFactor":[1,1,1],)"
        R"("occlusionTexture":{"index":0,"strength":0.5},"extensions":{"KHR_materials_specular":{)"
        R"("specularTexture":{"index":2},"specularColorTexture":{"index":1}}}})");
    const Material& m = scene.materials.at(0);
    const auto read_by = [&](const TextureSlot& slot) {
        return scene.textures.at(static_cast<std::size_t>(slot.texture)).name;
    };
    CHECK(read_by(m.base_color_texture) == "t6");
    CHECK(read_by(m.metallic_roughness_texture) == "t5");
    CHECK(read_by(m.normal_texture) == "t4");
    CHECK(read_by(m.emission_texture) == "t3");
    CHECK(read_by(m.specular_texture) == "t2");
    CHECK(read_by(m.specular_color_texture) == "t1");
    CHECK(m.emission_texture.uv_set == 1);
    CHECK(scene.textures.size() == 6);
}

TEST_CASE("a primitive without a material gets the default one", "[gltf]") {
    GltfBuilder builder;
    const Scene scene =
        load_text(builder.text(R"("nodes":[{"mesh":0}],"materials":[{"name":"unused"}],)" + triangle_meshes(builder)));
    const int index = scene.meshes.at(0).primitives.at(0).material;
    REQUIRE(index == 1);
    CHECK(scene.materials.at(1).base_color == glm::vec4(1));
    CHECK(scene.materials.at(1).metallic == 1);
}

TEST_CASE("a texture transform scales, then turns, then shifts, and may name another UV set", "[gltf]") {
    const Scene scene = load_material(
        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":0,"extensions":{"KHR_texture_transform":)"
        R"({"offset":[0.25,0.5],"rotation":1.5707963267948966,"scale":[2,3],"texCoord":1}}}}})");
    const TextureSlot& slot = scene.materials.at(0).base_color_texture;
    CHECK(slot.uv_set == 1);
    const glm::vec3 uv(0.1F, 0.2F, 1);
    // Scaled to (0.2, 0.6); a quarter turn counter-clockwise in the image, whose v points down, sends (u, v) to (v,
    // -u).
    CHECK(glm::dot(slot.u_row, uv) == Approx(0.25 + 0.6));
    CHECK(glm::dot(slot.v_row, uv) == Approx(0.5 - 0.2));
}

TEST_CASE("samplers decide wrapping and filtering", "[gltf]") {
    const std::string material = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})";
    const Texture plain = load_material(material).textures.at(0);
    CHECK(plain.wrap_u == Wrap::repeat);
    CHECK(plain.filter == Filter::linear);
    const Texture set =
        load_material(material, R"([{"magFilter":9728,"minFilter":9729,"wrapS":33071,"wrapT":33648}])").textures.at(0);
    CHECK(set.wrap_u == Wrap::clamp);
    CHECK(set.wrap_v == Wrap::mirror);
    CHECK(set.filter == Filter::nearest);
}

TEST_CASE("the default camera sees every corner of the scene", "[gltf]") {
    GltfBuilder builder;
    const Scene scene = load_text(builder.text(
        R"("nodes":[{"scale":[10,20,5],"translation":[1000,0,0],"mesh":0},{"rotation":[0,1,0,0],"mesh":0}],)" +
        triangle_meshes(builder)));
    const Bounds bounds = scene_bounds(scene);
    CHECK(near(bounds.lo, {-1, 0, 0}));
    CHECK(near(bounds.hi, {1010, 20, 0}));
    const Camera camera = frame_scene(scene);
    const glm::dmat4 to_camera = glm::inverse(camera.camera_to_world);
    const double slope = std::tan(camera.vertical_fov / 2);
    CHECK(camera.vertical_fov == Approx(std::numbers::pi / 4));
    double reach = 0;
    for (const glm::dvec3 corner : {bounds.lo, bounds.hi, glm::dvec3(-1, 20, 0), glm::dvec3(1010, 0, 0)}) {
        const glm::dvec3 seen = apply(to_camera, corner);
        REQUIRE(seen.z < 0);
        reach = std::max({reach, std::abs(seen.x / seen.z) / slope, std::abs(seen.y / seen.z) / slope});
    }
    CHECK(reach <= 1);
    CHECK(reach > 0.8);
    CHECK(is_empty(scene_bounds(Scene{})));
    CHECK(frame_scene(Scene{}).lens.focus_distance > 0);
}
