// The judge itself: it finds a planted fault of a few percent, and nothing where there is none.
#include <deque>

#include "backend/cpu_renderer.h"
#include "random_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

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

/// The CPU panel, told that the frame before had this frame's lights.
class ForgetsLights final : public Renderer {
public:
    explicit ForgetsLights(std::unique_ptr<Renderer> inner) : inner_(std::move(inner)) {}

    void move_to(const PackedScene& moment) override {
        wrong_ = std::make_unique<PackedScene>(moment);
        wrong_->previous_punctual_lights = wrong_->punctual_lights;
        wrong_->previous_emissive_triangles = wrong_->emissive_triangles;
        wrong_->revisions.previous_punctual_lights = wrong_->revisions.previous_emissive_triangles = 0;
        inner_->move_to(*wrong_);
        shown_ = std::move(wrong_);  // which inner_ refers to
    }
    std::string backend() const override { return inner_->backend(); }
    std::string device() const override { return inner_->device(); }
    Capabilities capabilities() const override { return inner_->capabilities(); }
    RendererCosts costs() const override { return inner_->costs(); }
    void render(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) override {
        inner_->render(first, count, cancel);
    }
    void restart(std::uint32_t seed) override { inner_->restart(seed); }
    void clear_film() override { inner_->clear_film(); }
    double device_seconds() const override { return inner_->device_seconds(); }
    Film film() const override { return inner_->film(); }
    TraversalBench bench_traversal(std::uint32_t samples) override { return inner_->bench_traversal(samples); }

private:
    std::unique_ptr<PackedScene> shown_;
    std::unique_ptr<PackedScene> wrong_;
    std::unique_ptr<Renderer> inner_;  // goes first
};

/// Of one moving scene under restir; the oracle is not asked.
std::vector<RandomPair> judged_moving(std::uint64_t seed, bool forgets) {
    const TestFolder folder;
    JudgeOptions options;
    options.integrators = {Integrator::restir};
    options.half_width_percent = 3;
    options.most_spp = 32;
    options.third_stage = 1;  // left out, since a stage of five frames takes long
    Renderers renderers = cpu_twice(1);
    renderers.cpu = [forgets](const Scene&, const PackedScene& packed, const RenderSettings&) {
        std::unique_ptr<Renderer> right = make_cpu_renderer(packed, 1);
        if (forgets) {
            right = std::make_unique<ForgetsLights>(std::move(right));
        }
        return right;
    };
    std::vector<RandomPair> pairs =
        compare_scene(make_moving_random_scene(seed), folder.file("scene.gltf"), renderers, options);
    judge_all(pairs, options);
    return pairs;
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
    const std::vector<RandomPair> pairs = judged(2, 1.05F);
    CHECK(verdict_of(pairs, JudgeOptions{}) == Verdict::fail);
    for (const RandomPair& pair : pairs) {
        INFO("seed " << pair.scene << ": " << pair.comparison.bias_percent << " %: " << pair.verdict.reason);
        CHECK(pair.stage == 3);
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

TEST_CASE("Moving random scenes show a frame before that has this frame's lights") {
    constexpr std::uint64_t seed = 301;  // a directional light turns
    for (const bool forgets : {false, true}) {
        const std::vector<RandomPair> pairs = judged_moving(seed, forgets);
        REQUIRE(pairs.size() == random_frames);
        CHECK((verdict_of(pairs, JudgeOptions{}) == Verdict::fail) == forgets);
        CHECK(pairs[0].verdict.verdict != Verdict::fail);  // which looks back to nothing
    }
}

TEST_CASE("A pair that differs by its p-value alone keeps random scenes from a PASS") {
    RandomPair pair;
    pair.side = "cpu/path";
    pair.comparison.half_width_percent = 0.5;
    pair.verdict.verdict = Verdict::inconclusive;  // its runs are too skewed for a FAIL
    pair.verdict.adjusted_p = 1e-5;
    CHECK(verdict_of({pair}, JudgeOptions{}) == Verdict::inconclusive);
    pair.verdict.adjusted_p = 0.5;
    CHECK(verdict_of({pair}, JudgeOptions{}) == Verdict::pass);
    pair.comparison.half_width_percent = 1.5;
    CHECK(verdict_of({pair}, JudgeOptions{}) == Verdict::inconclusive);
    pair.verdict.verdict = Verdict::fail;
    CHECK(verdict_of({pair}, JudgeOptions{}) == Verdict::fail);
}
