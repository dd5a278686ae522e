// Sequences and pictures of restir that go on from what came before.
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "backend/cpu_renderer.h"
#include "catch.h"
#include "image/image_file.h"
#include "image/metrics.h"
#include "pack/packed_scene.h"
#include "process.h"
#include "gltf/import.h"
#include "pose/pose.h"
#if DIPTYCH_VULKAN
#include "renderer/vulkan_renderer.h"
#endif

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

constexpr double first_moment = 0.9;
constexpr double fps = 10;

std::unique_ptr<Renderer> make_renderer(const std::string& backend, const PackedScene& packed) {
#if DIPTYCH_VULKAN
    if (backend == "vulkan") {
        return make_vulkan_renderer(packed, {});
    }
#endif
    CHECK(backend == "cpu");
    return make_cpu_renderer(packed, 0);
}

/// Frames of the scene one after another, `spp` samples each, as chains are tested: one renderer, moved and never
/// restarted.
std::vector<Image> chain_of(const std::string& file, const std::string& backend, std::uint32_t frames,
                            std::uint32_t spp) {
    Scene scene = load_gltf(file, {});
    RenderSettings settings;
    settings.width = 24;
    settings.height = 18;
    settings.integrator = Integrator::restir;
    settings.max_depth = 1;
    settings.seed = 5;
    settings.moves = true;
    settings.first_hit_layers = true;
    PackedScene packed = pack_scene(scene, settings);
    const auto renderer = make_renderer(backend, packed);
    renderer->restart(settings.seed);
    const std::atomic<bool> cancel{false};
    std::vector<Image> pictures;
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        renderer->clear_film();
        for (std::uint32_t i = 0; i < spp; ++i) {
            pose_scene(scene, first_moment + frame / fps);
            pack_moment(scene, settings, packed);
            renderer->move_to(packed);
            renderer->render(frame * spp + i, 1, cancel);
        }
        pictures.push_back(develop(renderer->film()).color);
    }
    return pictures;
}

std::vector<std::string> sequence(const std::string& scene, const std::string& output, const std::string& backend) {
    return {"render", scene,     "-o",  output,  "--size", "24x18",     "--integrator", "restir", "--max-depth",
            "1",      "--start", "0.9", "--fps", "10",     "--backend", backend,        "--seed", "5"};
}

void append(std::vector<std::string>& words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
}

std::vector<std::string> backends(const TemporaryFolder& folder) {
    const ProcessResult devices = run_diptych(folder, {"info", "--devices"});
    return devices.exit_code == 0 ? std::vector<std::string>{"cpu", "vulkan"} : std::vector<std::string>{"cpu"};
}

}  // namespace

TEST_CASE("A sequence of restir is one chain, and each of its frames repeats alone to the bit", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "moving-light");
    for (const std::string& backend : backends(folder)) {
        for (const std::uint32_t spp : {1U, 3U}) {
            INFO(backend << ", " << spp << " spp");
            std::vector<std::string> words = sequence(scene, folder.file("walk.exr"), backend);
            append(words, {"--spp", std::to_string(spp), "--frames", "4", "--overwrite"});
            const ProcessResult result = run_diptych(folder, words);
            INFO(result.err);
            REQUIRE(result.exit_code == 0);
            const std::vector<Image> chain = chain_of(scene, backend, 4, spp);
            LayeredImage last;
            for (std::size_t i = 0; i < chain.size(); ++i) {
                INFO("frame " << i);
                last = read_image(folder.file("walk.000" + std::to_string(i) + ".exr"));
                CHECK(last.color.data == chain[i].data);
                CHECK_FALSE(last.standard_error);
            }
            std::istringstream command(last.metadata.at("command"));
            std::vector<std::string> again;
            for (std::string word; command >> word;) {
                again.push_back(word);
            }
            again.erase(again.begin());
            std::filesystem::remove(folder.file("walk.0003.exr"));
            REQUIRE(run_diptych(folder, again).exit_code == 0);
            CHECK(read_image(folder.file("walk.0003.exr")).color.data == chain.back().data);
        }
    }
}

TEST_CASE("A chain that has warmed up is nearer to the truth than one that begins", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = folder.file("lights.glb");
    REQUIRE(run_diptych(folder, {"generate", "many-lights", "--count", "2000", "-o", scene}).exit_code == 0);
    const auto picture_of = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"render", scene,   "-o",          folder.file("a.exr"),
                                          "--size", "64x48", "--max-depth", "1",
                                          "--overwrite"};
        append(words, more);
        const ProcessResult result = run_diptych(folder, words);
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        return read_image(folder.file("a.exr"));
    };
    const LayeredImage truth = picture_of({"--integrator", "ris", "--spp", "512", "--seed", "9"});
    const auto relmse = [&](const std::vector<std::string>& more) {
        return compare_images(picture_of(more), truth).relmse_trimmed;  // lamps' edges, seen directly, are in both
    };
    // One candidate, so that much is left to be reused.
    const double cold = relmse({"--integrator", "restir", "--spp", "1", "--candidates", "1"});
    const double warm = relmse({"--integrator", "restir", "--spp", "1", "--candidates", "1", "--warm-up", "20"});
    INFO("cold " << cold << ", warm " << warm);
    CHECK(warm < 0.7 * cold);
}

TEST_CASE("Pictures of restir bear no standard errors and are no evidence for z", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    for (const std::string name : {"a.exr", "b.exr"}) {
        const ProcessResult result =
            run_diptych(folder, {"render", scene, "-o", folder.file(name), "--size", "16x16", "--spp", "4",
                                 "--integrator", "restir", "--json", "--seed", name == "a.exr" ? "1" : "2"});
        REQUIRE(result.exit_code == 0);
        const auto json = nlohmann::json::parse(result.out);
        CHECK(json.at("correlated") == true);
        CHECK(json.at("estimated_relmse").is_null());
        CHECK(json.at("pass_seconds").size() == 6);
        CHECK(read_image(folder.file(name)).albedo);
    }
    check_refusal(run_diptych(folder, {"compare", folder.file("a.exr"), folder.file("b.exr"), "--max-z", "4"}), 2,
                  {"--max-z", "verify"});
}

TEST_CASE("Chains that could not be repeated are refused", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const auto refuse = [&](const std::vector<std::string>& more, const std::string& part) {
        std::vector<std::string> words = {"render", scene, "-o", folder.file("no.exr")};
        append(words, more);
        check_refusal(run_diptych(folder, words), 2, {part});
    };
    refuse({"--warm-up", "3"}, "--warm-up");
    refuse({"--integrator", "restir", "--no-temporal", "--warm-up", "3"}, "--warm-up");
    refuse({"--integrator", "restir", "--frames", "2", "--time", "1"}, "--time");
}
