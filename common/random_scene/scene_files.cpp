#include "random_scene/scene_files.h"

#include <algorithm>

#include "error.h"
#include "image/image_file.h"
#include "scene/environment_load.h"
#include "gltf/import.h"
#include "gltf/write.h"

namespace diptych::core {

std::filesystem::path random_sky_path(const std::filesystem::path& path) {
    return path.parent_path() / (path.stem().string() + "-sky.exr");
}

namespace {

void write_sky(const Environment& sky, const std::filesystem::path& path) {
    Image image = make_image(sky.width, sky.height, 3);
    for (std::size_t i = 0; i < sky.texels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            image.data[3 * i + std::size_t(c)] = sky.texels[i][c];
        }
    }
    write_exr_channels(path, image, {"R", "G", "B"}, {});
}

/// Cameras that hang in nodes come last in the file.
void put_in_order(std::vector<Camera>& read, const std::vector<Camera>& drawn) {
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const auto found = std::find_if(read.begin(), read.end(), [&](const Camera& c) { return c.name == drawn[i].name; });
        if (found == read.end()) {
            throw Error("camera '" + drawn[i].name + "' was written but not read back");
        }
        std::swap(read[i], *found);
    }
}

}  // namespace

void write_random_scene(const RandomScene& random, const std::filesystem::path& path) {
    Scene in_file = random.scene;
    in_file.environment = {};
    write_gltf(in_file, path);
    if (random.scene.environment.kind == EnvironmentKind::map) {
        write_sky(random.scene.environment, random_sky_path(path));
    }
}

Scene read_random_scene(const RandomScene& random, const std::filesystem::path& path) {
    Scene scene = load_gltf(path);
    for (const std::string& line : scene.warnings.lines()) {
        if (line.find("lacks TEXCOORD_") == std::string::npos) {  // which is drawn on purpose
            throw Error(line);
        }
    }
    const Environment& sky = random.scene.environment;
    if (sky.kind == EnvironmentKind::map) {
        scene.environment = load_environment(random_sky_path(path).string());
    }
    scene.environment.kind = sky.kind;
    scene.environment.scale = sky.scale;
    scene.environment.rotation = sky.rotation;
    put_in_order(scene.cameras, random.scene.cameras);
    const auto camera = std::size_t(random.settings.camera);
    scene.cameras.at(camera).lens = random.scene.cameras[camera].lens;
    return scene;
}

}  // namespace diptych::core
