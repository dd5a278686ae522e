// No command writes over what it reads.
#include "catch.h"

#include <filesystem>

#include "generate/shapes.h"
#include "gltf/write.h"
#include "image/image_file.h"
#include "process.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

namespace fs = std::filesystem;

/// A square with a texture: scene.gltf, scene.bin and scene-wood.png.
std::string write_textured(const TemporaryFolder& folder) {
    Scene scene;
    scene.images.push_back({"wood", 1, 1, {200, 150, 100, 255}});
    scene.textures.push_back({});
    scene.textures.back().image = 0;
    Primitive square;
    square.material = add_material(scene, make_material("wood", glm::vec3(1), 0, 1));
    scene.materials.back().base_color_texture.texture = 0;
    add_quad(square, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
    add_object(scene, "square", {square});
    scene.cameras.push_back(make_camera("camera", {0, 0, 3}, {0, 0, 0}, 60));
    write_gltf(scene, folder.file("scene.gltf"));
    return folder.file("scene.gltf");
}

void write_grey(const std::string& file) {
    Image grey = make_image(8, 4, 3);
    std::fill(grey.data.begin(), grey.data.end(), 0.5F);
    write_hdr(file, grey);
}

/// The refusal of `output`, which names it and the input, and leaves the input as it was.
void check_kept(const TemporaryFolder& folder, const std::vector<std::string>& words, const std::string& output,
                const std::string& input) {
    INFO(output << " is " << input);
    const std::string before = file_text(folder.file(input));
    REQUIRE_FALSE(before.empty());
    check_refusal(run_diptych(folder, with(words, {"-o", folder.file(output)})), 2,
                  {folder.file(output) + ": cannot write: it is the file '" + folder.file(input) + "', which is read"});
    CHECK(file_text(folder.file(input)) == before);
}

}  // namespace

TEST_CASE("render does not write over its scene, buffers, textures or sky, whatever name they have", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = write_textured(folder);
    REQUIRE(fs::exists(folder.file("scene-wood.png")));
    write_grey(folder.file("sky.hdr"));
    fs::create_directory(folder.file("inner"));
    fs::create_symlink(folder.file("scene.bin"), folder.file("link.exr"));
    fs::create_hard_link(scene, folder.file("inner/hard.exr"));
    const std::vector<std::string> render = {"render", scene, "--env", folder.file("sky.hdr"), "--spp", "1", "--size",
                                             "8"};
    check_kept(folder, render, "./inner/../scene-wood.png", "scene-wood.png");
    check_kept(folder, render, "sky.hdr", "sky.hdr");
    check_kept(folder, render, "link.exr", "scene.bin");
    check_kept(folder, render, "inner/hard.exr", "scene.gltf");
    fs::copy_file(folder.file("scene-wood.png"), folder.file("other.png"));
    CHECK(run_diptych(folder, with(render, {"-o", folder.file("other.png")})).exit_code == 0);
}

TEST_CASE("a frame of a sequence does not write over a texture", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = write_textured(folder);
    fs::create_symlink(folder.file("scene-wood.png"), folder.file("walk.0002.png"));
    const ProcessResult result = run_diptych(folder, {"render", scene, "--frames", "4", "--spp", "1", "--size", "8", "-o",
                                                      folder.file("walk.png")});
    check_refusal(result, 2, {"walk.0002.png: cannot write: ", "scene-wood.png"});
    CHECK_FALSE(fs::exists(folder.file("walk.0000.png")));
}

TEST_CASE("compare does not write over what it compares", "[app]") {
    const TemporaryFolder folder;
    for (const char* name : {"a.png", "b.png", "c.png", "d.png"}) {
        write_png(folder.file(name), make_image(4, 4, 3));
    }
    const std::vector<std::string> compare = {"compare", folder.file("a.png"), folder.file("b.png"), "--minus",
                                              folder.file("c.png") + "," + folder.file("d.png")};
    for (const char* name : {"b.png", "d.png"}) {
        check_kept(folder, compare, name, name);
    }
    CHECK(run_diptych(folder, with(compare, {"-o", folder.file("e.png")})).exit_code == 0);
}

TEST_CASE("converge does not write over the pictures that it is given", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = write_textured(folder);
    fs::create_directories(folder.file("report/pictures"));
    write_hdr(folder.file("truth.hdr"), make_image(8, 8, 3));
    fs::create_symlink(folder.file("truth.hdr"), folder.file("report/pictures/cpu-path.exr"));
    const ProcessResult result = run_diptych(folder, {"converge", scene, "--methods", "cpu:path", "--reference",
                                                      folder.file("truth.hdr"), "-o", folder.file("report")});
    CHECK(result.exit_code == 2);
    CHECK(contains(result.err, "report/pictures/cpu-path.exr: cannot write: it is the file '" + folder.file("truth.hdr")));
    CHECK_FALSE(fs::exists(folder.file("report/plan.json")));
}
