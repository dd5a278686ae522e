// The judge itself: it finds a planted fault of a few percent, and nothing where there is none.
#include <deque>

#include "backend/cpu_renderer.h"
#include "random_fixture.h"

using namespace diptych;
using namespace diptych::tests;

namespace {

/// In the oracle's place, the CPU panel with every light so many times as bright, and other seeds.
Renderers cpu_twice(float factor) {
    static std::deque<PackedScene> kept;  // renderers refer to it
    Renderers out;
    out.cpu = [](const Scene&, const PackedScene& packed, const RenderSettings&) {
        return make_cpu_renderer(packed, 1);
    };
    out.oracle = [factor](const Scene& scene, const PackedScene&, const RenderSettings& settings) {
        Scene brighter = scene;
        brighter.environment.scale *= factor;
        for (Material& material : brighter.materials) {
            material.emission *= factor;
        }
        for (PunctualLight& light : brighter.lights) {
            light.intensity *= factor;
        }
        kept.push_back(pack_scene(brighter, settings));
        return make_cpu_renderer(kept.back(), 1);
    };
    return out;
}

std::vector<RandomPair> judged(std::uint64_t seeds, float factor) {
    const TestFolder folder;
    JudgeOptions options;
    options.integrators = {Integrator::path};
    options.half_width_percent = 2;
    options.most_spp = 64;
    std::vector<RandomPair> pairs;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const auto more = compare_scene(make_random_scene(seed), folder.file("scene.gltf"), cpu_twice(factor), options);
        pairs.insert(pairs.end(), more.begin(), more.end());
    }
    judge_all(pairs, options);
    return pairs;
}

}  // namespace

TEST_CASE("Random scenes show a side that is a twentieth brighter") {
    const std::vector<RandomPair> pairs = judged(4, 1.05F);
    CHECK(verdict_of(pairs, 2) == Verdict::fail);
    for (const RandomPair& pair : pairs) {
        INFO("seed " << pair.scene << ": " << pair.comparison.bias_percent << " %: " << pair.verdict.reason);
        CHECK(pair.stage == 2);
        CHECK(pair.verdict.verdict == Verdict::fail);
        CHECK(pair.comparison.bias_percent < -3);
    }
}

TEST_CASE("Random scenes show nothing between equal sides") {
    for (const RandomPair& pair : judged(6, 1)) {
        INFO("seed " << pair.scene << ": adjusted p " << pair.verdict.adjusted_p);
        CHECK(pair.verdict.verdict != Verdict::fail);
        CHECK(pair.comparison.half_width_percent > 0);
    }
}
