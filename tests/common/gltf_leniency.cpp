// Faulty files that a picture can be made of: what it is, the one warning, and the refusal where reading is strict.
#include <OpenImageIO/imageio.h>

#include "catch.h"
#include "error.h"
#include "gltf_fixture.h"
#include "image/image.h"
#include "image/image_file.h"
#include "pose/clips.h"
#include "gltf/import.h"
#include "pose/pose.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

std::string strict_refusal(const std::filesystem::path& file) {
    try {
        load_gltf(file, {.ignored_extensions = {}, .strict = true});
    } catch (const Error& error) {
        const std::string message = error.what();
        CHECK(message.find('\n') == std::string::npos);
        CHECK(message.rfind(file.string() + ": ", 0) == 0);
        return message;
    }
    return "(was loaded)";
}

/// Loads the file, whose one warning, and refusal where reading is strict, hold all of the parts.
Scene load_with_warning(const std::filesystem::path& file, const std::vector<std::string>& parts) {
    Scene scene = load_gltf(file);
    REQUIRE(scene.warnings.size() == 1);
    const std::string refusal = strict_refusal(file);
    for (const std::string& part : parts) {
        CHECK_THAT(scene.warnings.lines()[0], Catch::Contains(part));
        CHECK_THAT(refusal, Catch::Contains(part));
    }
    return scene;
}

/// A triangle in a scene that lists `listed` of these nodes.
std::string with_nodes(const std::string& listed, const std::string& nodes, const std::string& more = "") {
    GltfBuilder builder;
    const std::string position = std::to_string(builder.triangle());
    return builder.text(R"("scenes":[{"nodes":)" + listed + R"(}],"nodes":)" + nodes +
                        R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":)" + position + "}}]}]" + more);
}

/// A textured triangle; `slots` are members of its material, which may read textures[0].
std::string with_texture(const std::string& slots, const std::string& texture, const std::string& images,
                         const std::string& more = "") {
    GltfBuilder builder;
    const std::string position = std::to_string(builder.triangle());
    const std::string uvs = std::to_string(builder.floats({0, 0, 1, 0, 0, 1}, "VEC2", 3));
    return builder.text(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" + position +
                        R"(,"TEXCOORD_0":)" + uvs + R"(},"material":0}]}],"materials":[{)" + slots +
                        R"(}],"textures":[)" + texture + R"(],"images":[)" + images + "]" + more);
}

const char* const base_color = R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}})";

/// A picture of one colour, display values from 0 to 1.
void write_picture(const std::filesystem::path& file, float r, float g, float b) {
    const float color[] = {r, g, b};
    if (file.extension() == ".png") {
        Image image = make_image(8, 8, 3);
        for (std::size_t i = 0; i < image.data.size(); ++i) {
            image.data[i] = color[i % 3];
        }
        write_png(file, image);
        return;
    }
    std::vector<std::uint8_t> codes(8 * 8 * 3);
    for (std::size_t i = 0; i < codes.size(); ++i) {
        codes[i] = static_cast<std::uint8_t>(255 * color[i % 3]);
    }
    const auto output = OIIO::ImageOutput::create(file.string());
    REQUIRE(output);
    REQUIRE(output->open(file.string(), OIIO::ImageSpec(8, 8, 3, OIIO::TypeUInt8)));
    REQUIRE(output->write_image(OIIO::TypeUInt8, codes.data()));
    REQUIRE(output->close());
}

bool is_checker(const TextureImage& image) {
    int magenta = 0;
    int black = 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        const bool lit = image.rgba[i] == 255 && image.rgba[i + 2] == 255;
        const bool dark = image.rgba[i] == 0 && image.rgba[i + 2] == 0;
        if (image.rgba[i + 1] != 0 || image.rgba[i + 3] != 255 || !(lit || dark)) {
            return false;
        }
        (lit ? magenta : black) += 1;
    }
    return magenta > 0 && magenta == black;
}

}  // namespace

TEST_CASE("a scene's node that is another one's child is drawn once, under all of its ancestors", "[gltf]") {
    const TemporaryFolder folder;
    const std::string nodes = R"([{"translation":[1,0,0],"children":[1]},)"
                              R"({"name":"arm","translation":[0,2,0],"children":[2]},)"
                              R"({"name":"hand","mesh":0,"translation":[0,0,4]}])";
    const auto check = [&](const char* listed, const std::vector<std::string>& parts) {
        INFO(listed);
        const Scene scene = load_with_warning(folder.write("scene.gltf", with_nodes(listed, nodes)), parts);
        REQUIRE(scene.instances.size() == 1);
        CHECK(scene.instances[0].object_to_world[3] == glm::dvec4(1, 2, 4, 1));
    };
    check("[0,1]", {"nodes[1] (arm): is listed in scenes[0].nodes, but has a parent"});
    check("[2,0]", {"nodes[2] (hand)"});
    check("[2]", {"nodes[2] (hand)"});  // its ancestors are in no scene
    check("[0,0]", {"nodes[0]: is listed twice in scenes[0].nodes"});
    const Scene both = load_gltf(folder.write("all.gltf", with_nodes("[0,1,2]", nodes)));
    CHECK(both.instances.size() == 1);
    CHECK_THAT(both.warnings.lines().at(0), Catch::Contains("nodes[1] (arm)") && Catch::Contains("1 more object"));
}

TEST_CASE("a node moves with an animated ancestor that the scene does not list", "[gltf]") {
    GltfBuilder builder;
    builder.triangle();
    const int times = builder.floats({0, 1}, "SCALAR", 2);
    const int path = builder.floats({0, 0, 0, 6, 0, 0}, "VEC3", 2);
    const TemporaryFolder folder;
    Scene scene = load_gltf(folder.write(
        "scene.gltf",
        builder.text(R"("scenes":[{"nodes":[1]}],"nodes":[{"children":[1]},{"mesh":0,"translation":[0,2,0]}],)"
                     R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                     R"("animations":[{"samplers":[{"input":)" +
                     std::to_string(times) + R"(,"output":)" + std::to_string(path) +
                     R"(}],"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]}])")));
    pose_scene(scene, 0.5);
    CHECK(scene.instances.at(0).object_to_world[3] == glm::dvec4(3, 2, 0, 1));
}

TEST_CASE("a colour texture that is missing or broken is a checker, with a warning", "[gltf]") {
    const TemporaryFolder folder;
    const std::string texture = R"({"source":0})";
    const auto check = [&](const std::string& image, const std::vector<std::string>& parts) {
        INFO(image);
        for (const std::string slots : {base_color, R"("emissiveTexture":{"index":0})"}) {
            const Scene scene =
                load_with_warning(folder.write("scene.gltf", with_texture(slots, texture, image)), parts);
            REQUIRE(scene.images.size() == 1);
            CHECK(is_checker(scene.images[0]));
            CHECK(scene.textures.size() == 1);
        }
    };
    const std::string shown = "cannot be read; shown as a magenta-black checker";
    folder.write("wood.png", "");
    folder.write("stone.png", "\x89PNG\r\n\x1a\n and no more");
    check(R"({"uri":"gone.png"})", {"images[0] (gone.png)", shown, "no such file"});
    check(R"({"uri":"wod.png"})", {"images[0] (wod.png)", shown, "did you mean '", "wood.png'?"});
    check(R"({"uri":"wood.png"})", {"images[0] (wood.png)", shown, "neither PNG"});
    check(R"({"uri":"stone.png"})", {"images[0] (stone.png)", shown, "cannot be decoded"});
    check(R"({"bufferView":9})", {"images[0]", shown, "no bufferViews[9]"});
    check(R"({"name":"nothing"})", {"images[0] (nothing)", shown, "neither a URI nor a buffer view"});
}

TEST_CASE("many missing textures are one warning", "[gltf]") {
    const TemporaryFolder folder;
    const Scene scene = load_with_warning(
        folder.write("scene.gltf",
                     with_texture(std::string(base_color) + R"(,"emissiveTexture":{"index":1})",
                                  R"({"source":0},{"source":1})", R"({"uri":"a.png"},{"uri":"b.png"})")),
        {"images[0] (a.png)"});
    CHECK_THAT(scene.warnings.lines()[0], Catch::Contains("(and 1 more object)"));
    CHECK(scene.images.size() == 2);
}

TEST_CASE("a missing texture that holds no colour is left out", "[gltf]") {
    const TemporaryFolder folder;
    const Scene scene = load_with_warning(
        folder.write("scene.gltf", with_texture(R"("name":"m","normalTexture":{"index":0})", R"({"source":0})",
                                                R"({"uri":"gone.png"})")),
        {"materials[0] (m).normalTexture: is left out", "images[0] (gone.png)", "no such file"});
    CHECK(scene.materials.at(0).normal_texture.texture == none);
}

TEST_CASE("a texture of KHR_texture_basisu falls back on its other image", "[gltf]") {
    const TemporaryFolder folder;
    write_picture(folder.path() / "green.png", 0, 1, 0);
    folder.write("green.ktx2", "\xabKTX 20\xbb\r\n\x1a\n and more");
    const std::string images = R"({"uri":"green.ktx2"},{"uri":"green.png"})";
    const std::string extension = R"("extensions":{"KHR_texture_basisu":{"source":0}})";
    const std::string used = R"(,"extensionsUsed":["KHR_texture_basisu"])";
    const std::string required = used + R"(,"extensionsRequired":["KHR_texture_basisu"])";
    for (const std::string& declared : {used, required}) {
        const Scene scene = load_with_warning(
            folder.write("both.gltf", with_texture(base_color, R"({"source":1,)" + extension + "}", images, declared)),
            {"KHR_texture_basisu"});
        REQUIRE(scene.images.size() == 1);
        CHECK(scene.images[0].rgba[0] == 0);
        CHECK(scene.images[0].rgba[1] == 255);
    }
    const auto alone = [&](const std::string& declared) {
        return folder.write("alone.gltf", with_texture(base_color, "{" + extension + "}", images, declared));
    };
    const Scene scene = load_gltf(alone(used));
    CHECK(is_checker(scene.images.at(0)));
    CHECK_THAT(scene.warnings.lines().back(), Catch::Contains("images[0] (green.ktx2)") && Catch::Contains("KTX2"));
    CHECK_THROWS_WITH(load_gltf(alone(required)), Catch::Contains("needs KHR_texture_basisu"));
}

TEST_CASE("a texture of EXT_texture_webp is read, alone or beside another image", "[gltf]") {
    if (!OIIO::ImageOutput::create("webp")) {
        SKIP_TEST("this OpenImageIO does not write WebP");
    }
    const TemporaryFolder folder;
    write_picture(folder.path() / "red.webp", 1, 0, 0);
    write_picture(folder.path() / "green.png", 0, 1, 0);
    const std::string images = R"({"uri":"red.webp"},{"uri":"green.png"})";
    for (const std::string core : {"", R"("source":1,)"}) {
        const Scene scene = load_gltf(folder.write(
            "scene.gltf",
            with_texture(base_color, "{" + core + R"("extensions":{"EXT_texture_webp":{"source":0}}})", images,
                         R"(,"extensionsUsed":["EXT_texture_webp"],"extensionsRequired":["EXT_texture_webp"])")));
        CHECK(scene.warnings.empty());
        REQUIRE(scene.images.size() == 1);
        CHECK(scene.images[0].width == 8);
        CHECK(scene.images[0].rgba[0] > 245);  // WebP loses a little
        CHECK(scene.images[0].rgba[1] < 10);
    }
}

TEST_CASE("warnings of one kind are counted over the whole file", "[gltf]") {
    GltfBuilder builder;
    const std::string flat =
        std::to_string(builder.floats({0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 6));
    std::string meshes;
    std::string nodes;
    for (int i = 0; i < 98; ++i) {
        meshes += std::string(i == 0 ? "" : ",") + R"({"primitives":[{"attributes":{"POSITION":)" + flat + "}}]}";
        nodes += std::string(i == 0 ? "" : ",") + R"({"mesh":)" + std::to_string(i) + "}";
    }
    const TemporaryFolder folder;
    const Scene scene = load_with_warning(
        folder.write("scene.gltf", builder.text(R"("nodes":[)" + nodes + R"(],"meshes":[)" + meshes + "]")),
        {"meshes[0].primitives[0]: 1 triangles have no area; dropped"});
    CHECK(scene.warnings.lines()[0] ==
          (folder.path() / "scene.gltf").string() +
              ": meshes[0].primitives[0]: 1 triangles have no area; dropped (and 97 more objects; 98 in all)");
}

TEST_CASE("strictly read, faulty keyframes are refused though nothing plays", "[gltf]") {
    const std::filesystem::path folder = asset_folder() / "found/animation";
    if (!std::filesystem::exists(folder)) {
        SKIP_TEST("no assets at " + asset_folder().string());
    }
    Scene early = load_gltf(folder / "an_t_neg.glb");
    CHECK(early.warnings.empty());
    CHECK_THAT(clip_warnings(early).lines().at(0), Catch::Contains("keys before 0 s"));
    pose_scene(early, 0);
    CHECK(std::abs(early.instances.at(0).object_to_world[3].x - 0.2) < 1e-6);
    CHECK_THAT(strict_refusal(folder / "an_t_neg.glb"),
               Catch::Contains("animations[0]") && Catch::Contains("before 0 s"));

    Scene clips = load_gltf(folder / "an_clips.glb");
    play_all_clips(clips);
    CHECK_THAT(clip_warnings(clips).lines().at(0), Catch::Contains("clip 0 'walk'"));
    pose_scene(clips, 2);
    CHECK(glm::length(clips.instances.at(0).object_to_world[3] - glm::dvec4(0.5, 0, 0, 1)) < 1e-6);
    play_clip(clips, find_clip(clips, "idle"));
    pose_scene(clips, 2);
    CHECK(glm::length(clips.instances.at(0).object_to_world[3] - glm::dvec4(0, -0.5, 0, 1)) < 1e-6);
}
