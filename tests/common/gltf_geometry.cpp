// Geometry of hand-written glTF files with known numbers.
#include <glm/gtc/epsilon.hpp>

#include "catch.h"
#include "error.h"
#include "gltf_fixture.h"
#include "gltf/import.h"
#include "gltf/tangents.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

bool near(glm::vec3 a, glm::vec3 b) {
    return glm::length(a - b) < 1e-5F;
}

std::string position(int accessor) {
    return R"("attributes":{"POSITION":)" + std::to_string(accessor) + "}";
}

const Primitive& only_primitive(const Scene& scene) {
    REQUIRE(scene.meshes.size() == 1);
    REQUIRE(scene.meshes[0].primitives.size() == 1);
    return scene.meshes[0].primitives[0];
}

}  // namespace

TEST_CASE("sparse accessors replace elements, with and without a base", "[gltf]") {
    for (const bool with_base : {true, false}) {
        GltfBuilder builder;
        const int base = builder.view(raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}));
        const int indices = builder.view(raw<std::uint16_t>({0, 2}));
        const int values = builder.view(raw<float>({-1, -2, -3, 4, 5, 6}));
        const int sparse = builder.accessor_of(
            with_base ? R"("bufferView":)" + std::to_string(base) : "", 5126, "VEC3", 3,
            R"(,"sparse":{"count":2,"indices":{"bufferView":)" + std::to_string(indices) +
                R"(,"componentType":5123},"values":{"bufferView":)" + std::to_string(values) + "}}");
        const Scene scene = load_text(builder.text(one_mesh(position(sparse))));
        const std::vector<glm::vec3>& positions = only_primitive(scene).positions;
        REQUIRE(positions.size() == 3);
        CHECK(positions[0] == glm::vec3(-1, -2, -3));
        CHECK(positions[1] == (with_base ? glm::vec3(1, 0, 0) : glm::vec3(0)));
        CHECK(positions[2] == glm::vec3(4, 5, 6));
    }
}

TEST_CASE("strips and fans become triangles that all face the same way", "[gltf]") {
    GltfBuilder builder;
    const int points = builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3", 5);
    const int fan = builder.floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 4);
    const Scene strips = load_text(builder.text(one_mesh(position(points) + R"(,"mode":5)")));
    const std::vector<glm::uvec3> expected{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}};
    CHECK(only_primitive(strips).triangles == expected);
    const Scene fans = load_text(builder.text(one_mesh(position(fan) + R"(,"mode":6)")));
    for (const Scene* scene : {&strips, &fans}) {
        const Primitive& primitive = only_primitive(*scene);
        for (const glm::uvec3& t : primitive.triangles) {
            const glm::vec3 a = primitive.positions[t.x];
            CHECK(glm::cross(primitive.positions[t.y] - a, primitive.positions[t.z] - a).z > 0);
        }
    }
    CHECK(only_primitive(fans).triangles.size() == 2);
    const Scene lines = load_text(builder.text(one_mesh(position(points) + R"(,"mode":3)")));
    CHECK(lines.instances.empty());
    CHECK(lines.warnings.size() >= 1);
}

TEST_CASE("all index types and interleaved vertices are read", "[gltf]") {
    const auto indices_of = [](int which, GltfBuilder& builder) {
        switch (which) {
        case 0:
            return builder.accessor(raw<std::uint8_t>({2, 0, 1}), 5121, "SCALAR", 3);
        case 1:
            return builder.accessor(raw<std::uint16_t>({2, 0, 1}), 5123, "SCALAR", 3);
        default:
            return builder.accessor(raw<std::uint32_t>({2, 0, 1}), 5125, "SCALAR", 3);
        }
    };
    for (int which = 0; which < 3; ++which) {
        GltfBuilder builder;
        const int view = builder.view(raw<float>({0, 0, 0, .25F, .75F, 1, 0, 0, .5F, .5F, 0, 1, 0, .125F, 1}), 20);
        const std::string source = R"("bufferView":)" + std::to_string(view);
        const int points = builder.accessor_of(source, 5126, "VEC3", 3);
        const int uvs = builder.accessor_of(source + R"(,"byteOffset":12)", 5126, "VEC2", 3);
        const int indices = indices_of(which, builder);
        const Scene scene = load_text(
            builder.text(one_mesh(R"("attributes":{"POSITION":)" + std::to_string(points) + R"(,"TEXCOORD_0":)" +
                                  std::to_string(uvs) + R"(},"indices":)" + std::to_string(indices))));
        const Primitive& primitive = only_primitive(scene);
        CHECK(primitive.positions[2] == glm::vec3(0, 1, 0));
        CHECK(primitive.uvs[0][0] == glm::vec2(.25F, .75F));
        CHECK(primitive.uvs[0][2] == glm::vec2(.125F, 1));
        REQUIRE(primitive.triangles.size() == 1);
        CHECK(primitive.triangles[0] == glm::uvec3(2, 0, 1));
    }
}

TEST_CASE("quantised attributes are scaled as KHR_mesh_quantization says", "[gltf]") {
    GltfBuilder builder;
    // Rows of four components keep each vertex on a multiple of four bytes.
    const int points = builder.accessor(raw<std::int16_t>({0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0}), 5122, "VEC3",
                                        3, R"(,"normalized":true)", 8);
    const int normals = builder.accessor(raw<std::int8_t>({0, 0, 127, 0, 0, 0, 127, 0, 0, 0, -128, 0}), 5120, "VEC3", 3,
                                         R"(,"normalized":true)", 4);
    const int plain_uvs = builder.accessor(raw<std::uint16_t>({0, 0, 300, 7, 0, 65535}), 5123, "VEC2", 3);
    const int unit_uvs = builder.accessor(raw<std::uint8_t>({0, 0, 0, 0, 255, 51, 0, 0, 0, 255, 0, 0}), 5121, "VEC2", 3,
                                          R"(,"normalized":true)", 4);
    const std::string mesh = one_mesh(R"("attributes":{"POSITION":)" + std::to_string(points) + R"(,"NORMAL":)" +
                                      std::to_string(normals) + R"(,"TEXCOORD_0":)" + std::to_string(plain_uvs) +
                                      R"(,"TEXCOORD_1":)" + std::to_string(unit_uvs) + "}");
    const Scene scene = load_text(builder.text(
        R"("extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"],)" + mesh));
    CHECK(scene.warnings.empty());
    const Primitive& primitive = only_primitive(scene);
    CHECK(primitive.positions[1] == glm::vec3(1, 0, 0));
    CHECK(primitive.positions[2] == glm::vec3(0, -1, 0));
    CHECK(primitive.normals[0] == glm::vec3(0, 0, 1));
    CHECK(primitive.normals[2] == glm::vec3(0, 0, -1));
    CHECK(primitive.uvs[0][1] == glm::vec2(300, 7));
    CHECK(primitive.uvs[1][1].x == 1);
    CHECK(primitive.uvs[1][1].y == Approx(0.2F));
    const Scene undeclared = load_text(builder.text(mesh));
    REQUIRE(undeclared.warnings.size() == 1);
    CHECK_THAT(undeclared.warnings.lines()[0], Catch::Contains("quantised") && Catch::Contains("1 more object"));
}

TEST_CASE("vertex colours come in three encodings with three or four components", "[gltf]") {
    GltfBuilder builder;
    const int points = builder.triangle();
    const int floats = builder.floats({1, .5F, .25F, 0, 0, 0, 1, 1, 1}, "VEC3", 3);
    const int shorts = builder.accessor(raw<std::uint16_t>({65535, 0, 13107, 32896, 0, 0, 0, 0, 0, 0, 0, 0}), 5123,
                                        "VEC4", 3, R"(,"normalized":true)");
    const int bytes = builder.accessor(raw<std::uint8_t>({255, 51, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), 5121, "VEC3", 3,
                                       R"(,"normalized":true)", 4);
    const auto first_color = [&](int accessor) {
        const Scene scene = load_text(builder.text(one_mesh(R"("attributes":{"POSITION":)" + std::to_string(points) +
                                                            R"(,"COLOR_0":)" + std::to_string(accessor) + "}")));
        return only_primitive(scene).colors.at(0);
    };
    CHECK(glm::length(first_color(floats) - glm::vec4(1, .5F, .25F, 1)) < 1e-6F);
    CHECK(glm::length(first_color(shorts) - glm::vec4(1, 0, .2F, 32896 / 65535.0F)) < 1e-6F);
    CHECK(glm::length(first_color(bytes) - glm::vec4(1, .2F, 0, 1)) < 1e-6F);
}

TEST_CASE("morph weights are baked, and a mesh used with other weights is another mesh", "[gltf]") {
    GltfBuilder builder;
    const int points = builder.triangle();
    const int first = builder.floats({0, 0, 2, 0, 0, 2, 0, 0, 2}, "VEC3", 3);
    const int second = builder.floats({1, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3", 3);
    const Scene scene = load_text(
        builder.text(R"("scenes":[{"nodes":[0,1,2]}],"nodes":[{"mesh":0},{"mesh":0},{"mesh":0,"weights":[1,0]}],)"
                     R"("meshes":[{"weights":[0.5,2],"primitives":[{"attributes":{"POSITION":)" +
                     std::to_string(points) + R"(},"targets":[{"POSITION":)" + std::to_string(first) +
                     R"(},{"POSITION":)" + std::to_string(second) + "}]}]}]"));
    REQUIRE(scene.instances.size() == 3);
    CHECK(scene.meshes.size() == 2);
    CHECK(scene.instances[0].mesh == scene.instances[1].mesh);
    CHECK(scene.meshes[0].primitives[0].positions[0] == glm::vec3(2, 0, 1));
    const auto other = static_cast<std::size_t>(scene.instances[2].mesh);
    CHECK(scene.meshes[other].primitives[0].positions[0] == glm::vec3(0, 0, 2));
}

TEST_CASE("a skin is baked by joints times inverse bind matrices, without the node's own transform", "[gltf]") {
    GltfBuilder builder;
    const int points = builder.triangle();
    const int joints = builder.accessor(raw<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}), 5121, "VEC4", 3);
    const int weights = builder.floats({1, 0, 0, 0, 0, 1, 0, 0, .5F, .5F, 0, 0}, "VEC4", 3);
    const int inverse = builder.floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,  //
                                        1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1},
                                       "MAT4", 2);
    const Scene scene = load_text(builder.text(
        R"("scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0,"skin":0,"translation":[100,0,0]},)"
        R"({"children":[2],"translation":[0,0,5]},{"translation":[0,0,2]}],)"
        R"("skins":[{"joints":[1,2],"inverseBindMatrices":)" +
        std::to_string(inverse) + R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" + std::to_string(points) +
        R"(,"JOINTS_0":)" + std::to_string(joints) + R"(,"WEIGHTS_0":)" + std::to_string(weights) + "}}]}]"));
    const Primitive& primitive = only_primitive(scene);
    CHECK(scene.instances.at(0).object_to_world == glm::dmat4(1));
    CHECK(near(primitive.positions[0], {0, 0, 5}));
    CHECK(near(primitive.positions[1], {0, 0, 7}));
    CHECK(near(primitive.positions[2], {-0.5F, 1, 6}));
}

TEST_CASE("triangles with a vertex that is not finite are dropped and counted", "[gltf]") {
    GltfBuilder builder;
    const float infinity = std::numeric_limits<float>::infinity();
    const int points = builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, infinity, 0, 0}, "VEC3", 4);
    const int indices = builder.accessor(raw<std::uint16_t>({0, 1, 2, 1, 2, 3}), 5123, "SCALAR", 6);
    const Scene scene =
        load_text(builder.text(one_mesh(position(points) + R"(,"indices":)" + std::to_string(indices))));
    CHECK(only_primitive(scene).triangles.size() == 1);
    REQUIRE(scene.warnings.size() == 1);
    CHECK_THAT(scene.warnings.lines()[0], Catch::Contains("meshes[0] (m).primitives[0]: 1 triangles"));
}

TEST_CASE("derived tangents follow u, and w tells mirrored texture coordinates", "[gltf]") {
    for (const float direction : {1.0F, -1.0F}) {
        Primitive primitive;
        primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        primitive.triangles = {{0, 1, 2}};
        // v grows downward in the image, so upright texture coordinates fall as y grows.
        primitive.uvs[0] = {{0, 1}, {direction, 1}, {0, 0}};
        derive_tangents(primitive, TextureSlot{});
        REQUIRE(primitive.tangents.size() == 3);
        for (const glm::vec4& tangent : primitive.tangents) {
            CHECK(near(glm::vec3(tangent), {direction, 0, 0}));
            CHECK(tangent.w == direction);
        }
        CHECK(near(primitive.normals.at(0), {0, 0, 1}));
    }
    Primitive degenerate;
    degenerate.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    degenerate.normals.assign(3, glm::vec3(0, 0, 1));
    degenerate.triangles = {{0, 1, 2}};
    derive_tangents(degenerate, TextureSlot{});
    CHECK(std::abs(degenerate.tangents.at(0).z) < 1e-6F);
    CHECK(glm::length(glm::vec3(degenerate.tangents.at(0))) == Approx(1));
}
