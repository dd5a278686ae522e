// Scenes that load beside the one that is shown, and again when their files change.
#include "view/loader.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "generate/generate.h"
#include "gltf/files.h"
#include "gltf/write.h"
#include "view_fixture.h"

using namespace diptych::core;
using namespace diptych::core::app;
using namespace diptych::core::tests;

namespace {

namespace fs = std::filesystem;

/// A folder of its own, gone with the test.
struct Folder {
    fs::path path = fs::temp_directory_path() / ("diptych_loader_" + std::to_string(::getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
};

template <class Value>
Value await(const std::function<std::optional<Value>()>& look) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (std::chrono::steady_clock::now() < end) {
        if (std::optional<Value> found = look()) {
            return *std::move(found);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    FAIL("nothing came");
    throw Error("unreachable");
}

LoadedScene await_scene(SceneLoader& loader) {
    return await<LoadedScene>([&] { return loader.take_scene(); });
}

std::string await_error(SceneLoader& loader) {
    return await<std::string>([&] { return loader.take_error(); });
}

RenderRequest request_of(const fs::path& file) {
    RenderRequest request;
    request.scene = file.string();
    return request;
}

void write_text(const fs::path& file, const std::string& text) {
    std::ofstream(file) << text;
}

/// A later time than any write before it had, whatever the file system's clock.
void touch(const fs::path& file) {
    fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(2));
}

}  // namespace

TEST_CASE("A glTF's files are itself, its buffers and its images", "[view]") {
    const Folder folder;
    const fs::path file = folder.path / "a.gltf";
    write_text(file, R"({"buffers":[{"uri":"a%20b.bin"},{"uri":"data:;base64,AA=="},{"byteLength":4}],
                         "images":[{"uri":"x.png"},{"bufferView":0},{"uri":"x.png"},{"uri":"http://there/y.png"},7]})");
    CHECK(gltf_files(file) == std::vector<fs::path>{file, folder.path / "a b.bin", folder.path / "x.png"});
    write_text(file, "{\"buffers\": [");
    CHECK(gltf_files(file) == std::vector<fs::path>{file});
    CHECK(gltf_files(folder.path / "none.gltf") == std::vector<fs::path>{folder.path / "none.gltf"});
}

TEST_CASE("A scene that does not load says why and leaves the loader at work", "[view]") {
    const Folder folder;
    write_gltf(generate_scene("cornell").scene, folder.path / "good.gltf");
    write_text(folder.path / "bad.gltf", "{");
    SceneLoader loader;
    loader.open(request_of(folder.path / "bad.gltf"));
    CHECK(await_error(loader).find("bad.gltf") != std::string::npos);
    CHECK(!loader.take_scene());
    loader.open(request_of(folder.path / "good.gltf"));
    const LoadedScene loaded = await_scene(loader);
    CHECK(!loaded.reloaded);
    CHECK(loaded.generation > 1);
    CHECK(!loaded.scene->cameras.empty());
    CHECK(!is_empty(loaded.bounds));
    CHECK(!loader.take_error());
    CHECK(loader.loading().empty());
}

TEST_CASE("A view adds the sky that a render adds, to the scenes that need one", "[view]") {
    const Folder folder;
    Scene floor;
    Primitive level;
    level.material = add_material(floor, make_material("grey", glm::vec3(0.5F), 0, 1));
    add_quad(level, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
    Primitive label;  // beside the floor, and as bright as white paper
    label.material = add_material(floor, make_emitter("label", glm::vec3(1)));
    add_quad(label, {-0.1F, 0, 1.2F}, {0.1F, 0, 1.2F}, {0.1F, 0, 1.1F}, {-0.1F, 0, 1.1F});
    add_object(floor, "floor", {level, label});
    floor.cameras.push_back(make_camera("camera", {0, 2, 2}, {0, 0, 0}, 60));
    write_gltf(floor, folder.path / "label.gltf");
    write_gltf(generate_scene("cornell").scene, folder.path / "cornell.gltf");
    const LoadedScene lit = load_scene(request_of(folder.path / "label.gltf"), 1);
    CHECK(lit.scene->environment.kind == EnvironmentKind::constant);
    CHECK(lit.request.adds_neutral_sky);
    CHECK(lit.request.environment.empty());  // so that another scene, or this one changed, is looked at anew
    CHECK(lit.scene->warnings.size() == 1);
    RenderRequest next = lit.request;
    next.scene = (folder.path / "cornell.gltf").string();
    const LoadedScene cornell = load_scene(next, 2);
    CHECK(cornell.scene->environment.kind == EnvironmentKind::none);
    CHECK(!cornell.request.adds_neutral_sky);
    CHECK(cornell.scene->warnings.empty());
}

TEST_CASE("A scene is loaded again once its files have changed and hold still", "[view]") {
    const Folder folder;
    const fs::path file = folder.path / "scene.gltf";
    write_gltf(generate_scene("cornell").scene, file);
    const LoadedScene first = load_scene(request_of(file), 1);
    REQUIRE(first.files.size() >= 1);
    SceneLoader loader;
    loader.watch(first);
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    CHECK(!loader.take_scene());
    touch(first.files.back());
    const LoadedScene second = await_scene(loader);
    CHECK(second.reloaded);
    CHECK(second.generation > first.generation);
    loader.watch(second);
    // A burst of writes is one change.
    int loads = 0;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(3);
    for (int i = 0; std::chrono::steady_clock::now() < end; ++i) {
        if (i < 8) {
            touch(file);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(i < 8 ? 50 : 100));
        if (const std::optional<LoadedScene> again = loader.take_scene()) {
            loader.watch(*again);
            ++loads;
        }
    }
    CHECK(loads >= 1);
    CHECK(loads <= 2);
    // Half a file is an error, told once.
    write_text(file, "{");
    touch(file);
    CHECK(await_error(loader).find("scene.gltf") != std::string::npos);
    std::this_thread::sleep_for(std::chrono::milliseconds(800));
    CHECK(!loader.take_error());
}

TEST_CASE("A scene that was opened is not overwritten by the one before, whose files change", "[view]") {
    const Folder folder;
    const fs::path before = folder.path / "before.gltf";
    const fs::path after = folder.path / "after.gltf";
    write_gltf(generate_scene("cornell").scene, before);
    write_gltf(generate_scene("furnace").scene, after);
    SceneLoader loader;
    loader.watch(load_scene(request_of(before), 1));
    loader.open(request_of(after));
    const LoadedScene opened = await_scene(loader);
    touch(before);
    std::this_thread::sleep_for(std::chrono::milliseconds(1000));
    CHECK(!loader.take_scene());
    loader.watch(opened);
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    CHECK(!loader.take_scene());
    touch(after);
    CHECK(await_scene(loader).request.scene == after.string());
}
