// Other settings of the same scene, without building it anew.
#include <atomic>
#include <cmath>
#include <cstring>
#include <functional>

#include "error.h"
#include "gpu_fixture.h"
#include "renderer/path_renderer.h"
#include "generate/generate.h"

namespace diptych::core::tests {
namespace {

RenderSettings path_settings() {
    RenderSettings settings;
    settings.width = 24;
    settings.height = 18;
    settings.max_depth = 3;
    return settings;
}

Film picture_of(Renderer& renderer) {
    const std::atomic<bool> cancel = false;
    renderer.render(0, 3, cancel);
    return renderer.film();
}

/// One step of a walk: what it changes of the settings and of the scene's surroundings.
struct Change {
    const char* name;
    std::function<void(RenderSettings&, Scene&)> apply;
};

Environment gradient_sky(float blue) {
    Environment sky;
    sky.kind = Environment::Kind::map;
    sky.width = 8;
    sky.height = 4;
    for (int i = 0; i < 32; ++i) {
        sky.texels.emplace_back(0.1F * static_cast<float>(i), 0.5F, blue);
    }
    return sky;
}

/// Goes through the changes, each on top of those before, and compares with a new renderer after each.
void walk(const std::string& name, const std::vector<Change>& changes) {
    Scene scene = generate_scene(name).scene;
    RenderSettings settings = path_settings();
    PathRenderer renderer(open_test_gpu(), pack_scene(scene, settings));
    Film before = picture_of(renderer);
    for (const Change& change : changes) {
        CAPTURE(name, change.name);
        change.apply(settings, scene);
        const PackedScene packed = pack_scene(scene, settings);
        renderer.reconfigure(packed);
        const Film film = picture_of(renderer);
        PathRenderer fresh(open_test_gpu(), packed);  // which shares no pipeline with it
        CHECK(same_film(film, picture_of(fresh)));
        CHECK(renderer.costs().bytes == fresh.costs().bytes);
        CHECK(renderer.costs().acceleration_bytes == fresh.costs().acceleration_bytes);
        CHECK_FALSE(same_film(film, before));
        before = film;
    }
    check_no_validation_messages();
}

}  // namespace

// Every new renderer compiles its pipelines, which takes most of the time: many changes go together.
TEST_CASE("A renderer that was reconfigured has the bits of a new one, on the device") {
    NEED_VULKAN();
    walk("cornell",
         {{"restir that looks back, under a sky, with layers, of another size",
           [](RenderSettings& s, Scene& scene) {
               s.integrator = Integrator::restir;
               s.resampling.spatial_passes = 2;
               s.moves = s.standard_error = s.first_hit_layers = true;
               s.width = 17;
               scene.environment = gradient_sky(1);
           }},
          {"ris by power alone, under another sky of that size",
           [](RenderSettings& s, Scene& scene) {
               s.integrator = Integrator::ris;
               s.resampling.bsdf_candidate = false;
               s.moves = s.first_hit_layers = false;
               scene.environment = gradient_sky(4);
           }},
          {"path, with a sun and another BRDF, sampler, depth, seed",
           [](RenderSettings& s, Scene& scene) {
               s.integrator = Integrator::path;
               s.brdf = BrdfModel::blinn_phong;
               s.sampler = SamplerKind::independent;
               s.max_depth = 2;
               s.seed = 9;
               PunctualLight sun;
               sun.type = PunctualType::directional;
               sun.intensity = glm::vec3(3);
               scene.lights.push_back(sun);
           }},
          {"path with the layers of first hits", [](RenderSettings& s, Scene&) { s.first_hit_layers = true; }},
          {"material sampling without them", [](RenderSettings& s, Scene&) {
               s.integrator = Integrator::brdf;
               s.first_hit_layers = false;
           }}});
}

TEST_CASE("Textures and tangents stay when a renderer is reconfigured, on the device") {
    NEED_VULKAN();
    walk("normal-map", {{"material sampling, seen from elsewhere",
                         [](RenderSettings& s, Scene& scene) {
                             s.integrator = Integrator::brdf;
                             for (Camera& camera : scene.cameras) {
                                 camera.camera_to_world[3] += glm::dvec4(0.1, 0.2, 0.3, 0);
                             }
                         }},
                        {"everything allowed, path", [](RenderSettings& s, Scene&) {
                             s.integrator = Integrator::path;
                             s.generic = true;
                         }}});
}

TEST_CASE("Settings met before compile nothing, on the device") {
    NEED_VULKAN();
    const Scene scene = generate_scene("cornell").scene;
    RenderSettings path = path_settings();
    RenderSettings restir = path;
    restir.integrator = Integrator::restir;
    std::vector<std::string> steps;
    PathRendererOptions options;
    options.busy = [&](const std::string& what) { steps.push_back(what); };
    PathRenderer renderer(open_test_gpu(), pack_scene(scene, path), options);
    CHECK(renderer.pipelines_compiled() == 5);
    CHECK(steps == std::vector<std::string>{"building acceleration structures", "compiling 5 pipelines"});
    const Film first = picture_of(renderer);
    renderer.reconfigure(pack_scene(scene, restir));
    CHECK(steps.back() == "compiling 12 pipelines");
    const std::size_t compiled = renderer.pipelines_compiled();
    CHECK(compiled == 17);
    const Film resampled = picture_of(renderer);
    renderer.reconfigure(pack_scene(scene, path));
    CHECK(same_film(picture_of(renderer), first));
    renderer.reconfigure(pack_scene(scene, restir));
    CHECK(same_film(picture_of(renderer), resampled));
    CHECK(renderer.pipelines_compiled() == compiled);
    CHECK(steps.size() == 6);  // and three steps of taking over other settings
    check_no_validation_messages();
}

TEST_CASE("A renderer compiles no pipeline that another one on its device has compiled, on the device") {
    NEED_VULKAN();
    const Scene scene = generate_scene("cornell").scene;
    RenderSettings settings = path_settings();
    const std::shared_ptr<Gpu> gpu = open_test_gpu();
    const auto picture_and_count = [&](const std::shared_ptr<Gpu>& device) {
        PathRenderer renderer(device, pack_scene(scene, settings));
        const Film film = picture_of(renderer);
        return std::pair(film, renderer.pipelines_compiled());
    };
    const auto [first, compiled] = picture_and_count(gpu);
    CHECK(compiled == 5);
    const auto [second, compiled_again] = picture_and_count(gpu);
    CHECK(compiled_again == 0);
    CHECK(same_film(second, first));
    settings.standard_error = true;  // a feature that pipelines are specialised for
    const auto [other, compiled_anew] = picture_and_count(gpu);
    CHECK(compiled_anew == 5);
    CHECK(same_film(other, picture_and_count(open_test_gpu()).first));
    check_no_validation_messages();
}

TEST_CASE("A renderer that was reconfigured replays its own paths and names its own passes, on the device") {
    NEED_VULKAN();
    const Scene scene = generate_scene("cornell").scene;
    RenderSettings settings = path_settings();
    const std::shared_ptr<Gpu> gpu = open_test_gpu();
    PathRenderer renderer(gpu, pack_scene(scene, settings));
    const std::vector<shared::PathQuery> queries = {{.pixel = {3, 4}, .sample_index = 0},
                                                    {.pixel = {12, 9}, .sample_index = 2}};
    const std::vector<shared::PathSummary> shallow = renderer.summarize_paths(queries);
    settings.max_depth = 6;
    settings.first_hit_layers = true;
    const PackedScene packed = pack_scene(scene, settings);
    renderer.reconfigure(packed);
    const std::vector<shared::PathSummary> deep = renderer.summarize_paths(queries);
    PathRenderer fresh(gpu, packed);
    CHECK(same_bytes(deep, fresh.summarize_paths(queries)));
    CHECK_FALSE(same_bytes(deep, shallow));
    settings.integrator = Integrator::ris;
    renderer.reconfigure(pack_scene(scene, settings));
    picture_of(renderer);
    const std::vector<PassTime> passes = renderer.pass_times();
    if (!passes.empty()) {
        REQUIRE(passes.size() == 4);
        CHECK(passes[0].pass == "first hits");
        for (const PassTime& pass : passes) {
            CHECK(pass.seconds > 0);
        }
    }
    check_no_validation_messages();
}

TEST_CASE("A film that finds no room leaves a renderer that says so, and takes other settings, on the device") {
    NEED_VULKAN();
    const Scene scene = generate_scene("cornell").scene;
    RenderSettings settings = path_settings();
    PathRenderer renderer(open_test_gpu(), pack_scene(scene, settings));
    const Film before = picture_of(renderer);
    settings.width = settings.height = 1 << 20;
    for (int round = 0; round < 2; ++round) {
        CHECK_THROWS_WITH(renderer.reconfigure(pack_scene(scene, settings)),
                          Catch::Contains("out of memory: ") && Catch::Contains(" for the film"));
        CHECK_THROWS_WITH(picture_of(renderer), Catch::Contains("could not be taken over"));
        CHECK(renderer.device_film().film->width == 24);
    }
    renderer.reconfigure(pack_scene(scene, path_settings()));
    CHECK(same_film(picture_of(renderer), before));
    check_no_validation_messages();
}

TEST_CASE("A renderer refuses another scene's settings, and keeps its own, on the device") {
    NEED_VULKAN();
    const RenderSettings settings = path_settings();
    const std::shared_ptr<Gpu> gpu = open_test_gpu();
    PathRenderer renderer(gpu, generated_scene("cornell", settings));
    const Film before = picture_of(renderer);
    CHECK_THROWS_WITH(renderer.reconfigure(generated_scene("courtyard", settings)), Catch::Contains("another scene"));
    CHECK(same_film(renderer.film(), before));
    check_no_validation_messages();
}

}  // namespace diptych::core::tests
