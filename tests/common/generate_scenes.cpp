// What holds for every generated scene: its shape is sound, its files are valid, repeatable and the committed ones.
#include "catch.h"
#include "error.h"
#include "generate_fixture.h"
#include "gltf/encode_image.h"
#include "gltf/image.h"
#include "gltf/write.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sys/wait.h>

using namespace diptych::core;
using namespace diptych::core::generate_tests;

namespace {

const std::filesystem::path sources = DIPTYCH_SOURCE_DIR;

/// The exit status of the validator script over files, or 77 where node or the validator is missing.
int validate(const std::string& files) {
    if (std::system("node --version > /dev/null 2>&1") != 0) {
        return 77;
    }
    const std::string script = (sources / "tests/validator/validate.mjs").string();
    const int status = std::system(("node '" + script + "' " + files).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TextureImage decoded(const std::string& bytes) {
    MemoryBudget budget(0);
    return gltf::decode_image({"", {bytes.begin(), bytes.end()}, ""}, budget);
}

/// The pixels, because the bytes of a PNG depend on the version of zlib.
void check_same_picture(const std::filesystem::path& a, const std::filesystem::path& b) {
    const TextureImage image_a = decoded(file_bytes(a)), image_b = decoded(file_bytes(b));
    CHECK(image_a.width == image_b.width);
    CHECK(image_a.height == image_b.height);
    CHECK(image_a.rgba == image_b.rgba);
}

bool is_small(const std::string& name) {
    return name != "many-lights";
}

}  // namespace

TEST_CASE("an unknown scene is refused with the names of those there are", "[generate]") {
    try {
        generate_scene("cornel");
        FAIL("it was accepted");
    } catch (const Error& error) {
        const std::string message = error.what();
        CHECK(message.find("'cornel'") != std::string::npos);
        for (const SceneGenerator& generator : scene_generators()) {
            CHECK(message.find(generator.name) != std::string::npos);
        }
    }
}

TEST_CASE("generated scenes are well formed", "[generate]") {
    for (const SceneGenerator& generator : scene_generators()) {
        INFO(generator.name);
        const Scene scene = generate_scene(generator.name).scene;
        CHECK(scene.name == generator.name);
        REQUIRE(!scene.cameras.empty());
        for (const Camera& camera : scene.cameras) {
            CHECK(!camera.name.empty());
        }
        bool emits = scene.environment.kind == Environment::Kind::constant;
        for (const Mesh& mesh : scene.meshes) {
            for (const Primitive& primitive : mesh.primitives) {
                const Material& material = scene.materials.at(std::size_t(primitive.material));
                emits = emits || material.emission != glm::vec3(0);
                CHECK((primitive.normals.empty() || primitive.normals.size() == primitive.positions.size()));
                CHECK((material.normal_texture.texture != none) == !primitive.tangents.empty());
                for (const glm::uvec3& t : primitive.triangles) {
                    const glm::dvec3 a = primitive.positions.at(t.x), b = primitive.positions.at(t.y),
                                     c = primitive.positions.at(t.z);
                    const glm::dvec3 front = glm::cross(b - a, c - a);
                    if (!(glm::length(front) > 1e-9)) {
                        FAIL_CHECK("a degenerate triangle");
                    }
                    for (int i = 0; i < 3 && !primitive.normals.empty(); ++i) {
                        const glm::dvec3 normal = primitive.normals[t[i]];
                        if (std::abs(glm::length(normal) - 1) > 1e-5) {
                            FAIL_CHECK("a normal of another length than 1");
                        }
                        if (glm::dot(normal, glm::normalize(front)) < 0.8) {
                            FAIL_CHECK("a normal that leaves the front");
                        }
                    }
                }
            }
        }
        CHECK(emits);
    }
}

TEST_CASE("no two triangles of a generated scene coincide", "[generate]") {
    for (const SceneGenerator& generator : scene_generators()) {
        INFO(generator.name);
        const Scene scene = generate_scene(generator.name).scene;
        std::map<std::array<long, 9>, int> seen;
        for (const Instance& instance : scene.instances) {
            for (const WorldTriangle& triangle : world_triangles(scene, instance)) {
                std::array<std::array<long, 3>, 3> corners;
                const std::array<glm::dvec3, 3> points{triangle.a, triangle.b, triangle.c};
                for (std::size_t i = 0; i < 3; ++i) {
                    for (int k = 0; k < 3; ++k) {
                        corners[i][std::size_t(k)] = std::lround(points[i][k] * 1e5);
                    }
                }
                std::sort(corners.begin(), corners.end());
                std::array<long, 9> key{};
                for (std::size_t i = 0; i < 9; ++i) {
                    key[i] = corners[i / 3][i % 3];
                }
                ++seen[key];
            }
        }
        const bool once = std::all_of(seen.begin(), seen.end(), [](const auto& entry) { return entry.second == 1; });
        CHECK(once);
    }
}

TEST_CASE("closed shapes of generated scenes are closed", "[generate]") {
    // Over a closed surface the area vectors add up to nothing.
    const std::pair<const char*, const char*> closed[] = {
        {"veach-mis", "plate 1"}, {"veach-mis", "light 3"}, {"brdf-grid", "studio"},  {"furnace", "room"},
        {"furnace", "ball"},      {"courtyard", "roof"},    {"courtyard", "gallery"}, {"courtyard", "orb"}};
    for (const auto& [name, object] : closed) {
        INFO(name << ": " << object);
        const Scene scene = generate_scene(name).scene;
        glm::dvec3 sum(0);
        double volume = 0;
        for (const WorldTriangle& triangle : world_triangles(scene, find_instance(scene, object))) {
            sum += triangle.area_vector();
            volume += glm::dot(triangle.area_vector(), triangle.center()) / 3;
        }
        CHECK(glm::length(sum) < 1e-4);
        const bool looks_inwards = std::string(object) == "room" || std::string(object) == "studio";
        CHECK((volume < 0) == looks_inwards);
    }
}

TEST_CASE("the lights of veach-mis have one power", "[generate]") {
    const Scene scene = generate_scene("veach-mis").scene;
    std::vector<double> powers;
    for (const char* name : {"light 1", "light 2", "light 3", "light 4"}) {
        double sum = 0;
        for (const WorldTriangle& triangle : world_triangles(scene, find_instance(scene, name))) {
            const glm::dvec3 radiance(triangle.material->emission);
            sum += glm::length(triangle.area_vector()) * (radiance.x + radiance.y + radiance.z);
        }
        powers.push_back(sum);
    }
    for (const double power : powers) {
        CHECK(std::abs(power / powers[0] - 1) < 1e-4);
    }
}

TEST_CASE("every surface of the furnace emits and reflects alike", "[generate]") {
    const Scene scene = generate_scene("furnace").scene;
    REQUIRE(scene.materials.size() == 1);
    const Material& material = scene.materials[0];
    CHECK(glm::vec3(material.base_color) == glm::vec3(0.5F));
    CHECK(material.emission / (glm::vec3(1) - glm::vec3(material.base_color)) == glm::vec3(0.5F));
    CHECK(material.specular == 0);
    CHECK(material.metallic == 0);
    for (const Mesh& mesh : scene.meshes) {
        CHECK(mesh.primitives.at(0).normals.empty());
    }
}

TEST_CASE("the committed scenes are what the generators write", "[generate]") {
    const TemporaryFolder folder;
    std::size_t compared = 0;
    for (const SceneGenerator& generator : scene_generators()) {
        if (!is_small(generator.name)) {
            continue;
        }
        write_gltf(generate_scene(generator.name).scene, folder.path() / (std::string(generator.name) + ".gltf"));
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        INFO(entry.path().filename());
        const std::filesystem::path committed = sources / "scenes" / entry.path().filename();
        CHECK(std::filesystem::file_size(entry.path()) < 300'000);
        if (entry.path().extension() == ".png") {
            check_same_picture(entry.path(), committed);
        } else {
            CHECK(file_bytes(entry.path()) == file_bytes(committed));
        }
        ++compared;
    }
    CHECK(compared >= 2 * 8 + 2);
}

TEST_CASE("a texture is written as it is, without a colour space, and without alpha where it is opaque", "[generate]") {
    constexpr std::size_t color_type = 25;  // its place in a PNG: 2 is RGB, 6 is RGBA (W3C PNG, 11.2.1)
    TextureImage image{"a", 16, 2, {}};
    for (int i = 0; i < 32; ++i) {
        image.rgba.insert(image.rgba.end(), {std::uint8_t(8 * i), std::uint8_t(255 - i), 3, std::uint8_t(8 * i)});
    }
    for (const bool opaque : {false, true}) {
        INFO("opaque: " << opaque);
        for (std::size_t i = 3; opaque && i < image.rgba.size(); i += 4) {
            image.rgba[i] = 255;
        }
        const std::vector<std::uint8_t> png = gltf::encode_image(image);
        const std::string bytes(png.begin(), png.end());
        REQUIRE(png.size() > color_type);
        CHECK(int(png[color_type]) == (opaque ? 2 : 6));
        for (const char* chunk : {"sRGB", "gAMA", "cHRM", "iCCP"}) {
            CHECK(bytes.find(chunk) == std::string::npos);
        }
        const TextureImage back = decoded(bytes);
        CHECK(back.width == image.width);
        CHECK(back.rgba == image.rgba);  // colours under alpha 0 too
    }
    image.rgba.pop_back();
    CHECK_THROWS_AS(gltf::encode_image(image), Error);
}

TEST_CASE("generated files repeat to the byte", "[generate]") {
    const TemporaryFolder folder;
    const GenerateOptions options{.count = 3000, .seed = 5};
    for (const SceneGenerator& generator : scene_generators()) {
        INFO(generator.name);
        for (const char* file : {"first.glb", "second.glb"}) {
            write_gltf(generate_scene(generator.name, options).scene, folder.path() / file);
        }
        const std::string first = file_bytes(folder.path() / "first.glb");
        CHECK(first.size() > 1000);
        CHECK(first == file_bytes(folder.path() / "second.glb"));
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        CHECK(entry.path().extension() == ".glb");  // no temporary file stays behind
    }
}

TEST_CASE("generated files pass the Khronos validator", "[generate]") {
    const TemporaryFolder folder;
    std::string files;
    for (const SceneGenerator& generator : scene_generators()) {
        for (const char* extension : {".gltf", ".glb"}) {
            const auto path = folder.path() / (generator.name + std::string(extension));
            write_gltf(generate_scene(generator.name).scene, path);
            files += " '" + path.string() + "'";
        }
    }
    for (const auto& entry : std::filesystem::directory_iterator(sources / "scenes")) {
        if (entry.path().extension() == ".gltf") {
            files += " '" + entry.path().string() + "'";
        }
    }
    const int status = validate(files);
    if (status == 77) {
        SKIP_TEST("no node, or no npm package gltf-validator");
    }
    CHECK(status == 0);

    std::ofstream(folder.path() / "broken.gltf") << R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 3}]})";
    CHECK(validate("'" + (folder.path() / "broken.gltf").string() + "'") == 1);
}

TEST_CASE("an unwritable or unknown file is refused", "[generate]") {
    const Scene scene = generate_scene("furnace").scene;
    CHECK_THROWS_AS(write_gltf(scene, "furnace.obj"), Error);
    CHECK_THROWS_AS(write_gltf(scene, "/nonexistent-folder/furnace.gltf"), Error);
}
