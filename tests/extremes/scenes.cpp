// The scenes of scenes/extremes: as generated, and without a sample that is no number on either backend.
#include <atomic>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "extremes.h"
#include "render/film.h"
#include "generate/generate.h"
#include "gltf/import.h"
#include "gltf/write.h"
#if DIPTYCH_VULKAN
#include "vulkan_device.h"
#endif

namespace diptych::core::tests {

namespace {

const std::filesystem::path folder = std::filesystem::path(DIPTYCH_SOURCE_DIR) / "scenes/extremes";

std::string file_of(const SceneGenerator& generator) {
    return std::string(generator.name).substr(std::string("extreme-").size());
}

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    return bytes.str();
}

Film render_small(stability::Backend& backend, const Scene& scene, Integrator integrator) {
    RenderSettings settings;
    settings.width = settings.height = 24;
    settings.integrator = integrator;
    const PackedScene packed = pack_scene(scene, settings);
    const auto renderer = backend.make_renderer(packed);
    const std::atomic<bool> cancel{false};
    renderer->render(0, 8, cancel);
    return renderer->film();
}

void check_finite(stability::Backend& backend) {
    for (const SceneGenerator& generator : extreme_scene_generators()) {
        const Scene scene = load_gltf((folder / (file_of(generator) + ".gltf")).string());
        const FilmTotals totals = film_totals(render_small(backend, scene, Integrator::path));
        INFO(backend.name() << ": " << generator.name);
        CHECK(totals.nonfinite == 0);
        CHECK(totals.samples == 24 * 24 * 8);
    }
}

}  // namespace

TEST_CASE("Extreme scenes are the generated ones") {
    const std::filesystem::path scratch = std::filesystem::temp_directory_path() / "diptych-extreme-scenes";
    std::filesystem::create_directories(scratch);
    for (const SceneGenerator& generator : extreme_scene_generators()) {
        const std::string name = file_of(generator);
        write_gltf(generator.generate({}).scene, scratch / (name + ".gltf"));
        for (const char* extension : {".gltf", ".bin"}) {
            INFO(name << extension);
            CHECK(bytes_of(scratch / (name + extension)) == bytes_of(folder / (name + extension)));
        }
        // Of images the pixels, because the bytes of a PNG depend on the version of zlib.
        const Scene written = load_gltf((scratch / (name + ".gltf")).string());
        const Scene committed = load_gltf((folder / (name + ".gltf")).string());
        REQUIRE(written.images.size() == committed.images.size());
        for (std::size_t i = 0; i < written.images.size(); ++i) {
            INFO(name << ": " << written.images[i].name);
            CHECK(written.images[i].width == committed.images[i].width);
            CHECK(written.images[i].rgba == committed.images[i].rgba);
        }
    }
    std::filesystem::remove_all(scratch);
}

TEST_CASE("Extreme scenes give nothing but numbers") {
    check_finite(*stability::make_cpu_backend(0));
}

TEST_CASE("Extreme scenes give nothing but numbers on the device", "[nightly]") {
#if DIPTYCH_VULKAN
    NEED_VULKAN();
    check_finite(*stability::make_vulkan_backend("", has_validation_layer()));
    check_no_validation_messages();
#else
    SKIP_TEST("built without Vulkan");
#endif
}

TEST_CASE("A broken mesh is cleaned, and what was dropped is counted") {
    const Scene scene = load_gltf((folder / "broken-mesh.gltf").string());
    std::string all;
    for (const std::string& warning : scene.warnings.lines()) {
        all += warning + "\n";
    }
    INFO(all);
    CHECK(all.find("2 triangles have a vertex that is not finite; dropped") != std::string::npos);
    CHECK(all.find("4 triangles have no area; dropped") != std::string::npos);
    for (const Mesh& mesh : scene.meshes) {
        for (const Primitive& primitive : mesh.primitives) {
            CHECK(primitive.triangles.size() <= 224);
        }
    }
}

}  // namespace diptych::core::tests
