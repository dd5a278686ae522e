// What restir keeps, pixel by pixel and pass by pass: with the same random numbers both panels choose the same light
// points.
#include <cstdio>

#include "../restir/chain_cases.h"
#include "pose/pose.h"
#include "panels_fixture.h"

namespace diptych::core::tests {
namespace {

struct Watched {
    ResamplingStep step;
    std::vector<shared::Reservoir> reservoirs;
};

/// Frames 0 .. frames-1 of a case, after every pass.
std::vector<Watched> watch(const ChainCase& c, std::uint32_t frames, const MakeRenderer& make) {
    Scene scene = c.scene;
    RenderSettings settings = c.settings;
    settings.width = 48;
    settings.height = 36;
    settings.moves = c.seconds > 0;
    PackedScene packed = pack_scene(scene, settings);
    const auto renderer = make(packed);
    std::vector<Watched> watched;
    renderer->watch_reservoirs([&](const ResamplingStep& step, std::span<const shared::Reservoir> reservoirs) {
        if (step.stage != ResamplingStage::first_hits) {  // before which they hold nothing yet
            watched.push_back({step, {reservoirs.begin(), reservoirs.end()}});
        }
    });
    const std::atomic<bool> cancel{false};
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        if (settings.moves) {
            pose_scene(scene, c.start + frame * c.seconds);
            pack_moment(scene, settings, packed);
            renderer->move_to(packed);
        }
        renderer->render(frame, 1, cancel);
    }
    return watched;
}

bool alike(const shared::Reservoir& a, const shared::Reservoir& b) {
    const glm::vec2 apart = glm::abs(a.point.uv - b.point.uv);
    return a.point.light == b.point.light && a.favor == b.favor && apart.x <= 1e-4F && apart.y <= 1e-4F &&
           std::abs(a.weight - b.weight) <= 1e-3F * std::max(a.weight, b.weight) &&
           std::abs(a.confidence - b.confidence) <= 1e-4F * std::max(a.confidence, b.confidence);
}

void check_alike(const ChainCase& c, std::uint32_t frames) {
    const auto cpu = watch(c, frames, on_cpu);
    const auto vulkan = watch(c, frames, [](const PackedScene& packed) { return make_vulkan_renderer(panels_gpu(), packed); });
    const std::vector<std::string> passes = pass_names(pack_scene(c.scene, c.settings).constants);
    REQUIRE(cpu.size() == vulkan.size());
    for (std::size_t i = 0; i < cpu.size(); ++i) {
        REQUIRE(cpu[i].step.place == vulkan[i].step.place);
        REQUIRE(cpu[i].reservoirs.size() == vulkan[i].reservoirs.size());
        std::size_t same = 0;
        std::size_t filled = 0;
        for (std::size_t pixel = 0; pixel < cpu[i].reservoirs.size(); ++pixel) {
            same += alike(cpu[i].reservoirs[pixel], vulkan[i].reservoirs[pixel]) ? 1 : 0;
            filled += cpu[i].reservoirs[pixel].weight > 0 ? 1 : 0;
        }
        const double share = static_cast<double>(same) / static_cast<double>(cpu[i].reservoirs.size());
        const std::uint32_t frame = cpu[i].step.pass.frame;
        std::printf("%s, frame %u, %s: %.4f alike, %zu not empty\n", c.name.c_str(), frame,
                    passes[cpu[i].step.place].c_str(), share, filled);
        INFO(c.name << ", frame " << frame << ", " << passes[cpu[i].step.place]);
        CHECK(share >= 0.995);
        CHECK(filled > 100);
    }
}

}  // namespace

TEST_CASE("Both panels keep the same reservoirs, pass by pass") {
    NEED_VULKAN();
    ChainCase lights = chain_case("many lights", generated("many-lights", 300));
    lights.settings.resampling.spatial_passes = 2;
    check_alike(lights, 4);
    ChainCase glossy = chain_case("glossy slats, visibility in the target", slats(true));
    glossy.settings.resampling.visibility = ResamplingVisibility::target;
    check_alike(glossy, 4);
    ChainCase sky = chain_case("sky alone, all features", under_sky());
    sky.settings.generic = true;
    check_alike(sky, 2);
    ChainCase moving = chain_case("moving light", generated("moving-light"));
    moving.start = 0.5;
    moving.seconds = 0.125;
    check_alike(moving, 6);
    ChainCase alone = chain_case("ris", generated("veach-mis"));
    alone.settings.integrator = Integrator::ris;
    check_alike(alone, 2);
    alone.name = "ris, by power alone";
    alone.settings.resampling.bsdf_candidate = false;
    check_alike(alone, 2);
    check_no_validation_messages();
}

}  // namespace diptych::core::tests
