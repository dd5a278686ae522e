// What a pass hands on instead of having the next one work it out again is what that would come to.
#include <cstdio>
#include <map>
#include <set>
#include <tuple>

#include "backend/resampling_stages.h"
#include "../cpu/test_kernel.h"
#include "chain_cases.h"

namespace diptych::core::tests {
namespace {

/// A chain's passes over a whole film, of which the test sees everything.
struct Chain {
    PackedScene packed;
    EmbreeScene embree;
    ResamplingFilms films;
    Kernel kernel;
    ResamplingSchedule schedule;

    explicit Chain(const Scene& scene, const RenderSettings& settings)
        : packed(pack_scene(scene, settings)), embree(packed),
          films(packed.constants), kernel{packed, packed.constants, {{embree}}, &films}, schedule(packed.constants) {}

    template <class Pass>
    void for_pixels(Pass&& pass) {
        for (std::uint32_t i = 0; i < films.pixels; ++i) {
            pass(i, shared::uvec2(i % packed.constants.size.x, i / packed.constants.size.x));
        }
    }

    /// All stages but shade; `check` after each that leaves reservoirs.
    template <class Check>
    void run_frame(std::uint32_t frame, Check&& check) {
        for (const ResamplingStep& step : schedule.next_frame(frame)) {
            for_pixels([&](std::uint32_t, shared::uvec2 pixel) { run_stage(kernel, step, pixel); });
            if (step.stage != ResamplingStage::first_hits) {
                check(step);
            }
        }
    }
};

RenderSettings settings_of(Integrator integrator) {
    RenderSettings settings;
    settings.width = 32;
    settings.height = 24;
    settings.integrator = integrator;
    return settings;
}

/// Which share of the points that pixels end with is hidden, once there is a past; `favors`: whether it is remembered.
double share_hidden(const Scene& scene, bool favors) {
    Chain chain(scene, settings_of(Integrator::restir));
    double hidden = 0;
    double chosen = 0;
    int wrong = 0;
    for (std::uint32_t frame = 0; frame < 64; ++frame) {
        chain.run_frame(frame, [&](const ResamplingStep& step) {
            if (step.stage != ResamplingStage::shadows) {
                return;
            }
            chain.for_pixels([&](std::uint32_t index, shared::uvec2) {
                auto reservoir = chain.kernel.load_reservoir(resulting_set(step), index);
                if (!(reservoir.weight > 0)) {
                    return;
                }
                const bool is_hidden = chain.kernel.load_first_vertex(index).occluded != 0;
                wrong += reservoir.favor == (is_hidden ? shared::FAVOR_HIDDEN : 1.0F) ? 0 : 1;
                hidden += frame > 3 && is_hidden ? 1 : 0;
                chosen += frame > 3 ? 1 : 0;
                if (!favors) {
                    reservoir.favor = 1;
                    chain.kernel.store_reservoir(resulting_set(step), index, reservoir);
                }
            });
        });
    }
    CHECK(wrong == 0);
    return hidden / chosen;
}

using PointKey = std::tuple<std::uint32_t, float, float>;

PointKey key_of(const shared::LightPoint& point) {
    return {point.light, point.uv.x, point.uv.y};
}

}  // namespace

TEST_CASE("A reservoir's target is that of its point at its surface, after every pass") {
    const std::string name = GENERATE("many-lights", "veach-mis");
    CAPTURE(name);
    Chain chain(generated(name, 300), settings_of(Integrator::restir));
    int checked = 0;
    for (std::uint32_t frame = 0; frame < 3; ++frame) {
        chain.run_frame(frame, [&](const ResamplingStep& step) {
            int wrong = 0;
            chain.for_pixels([&](std::uint32_t index, shared::uvec2) {
                const auto kept = chain.kernel.load_reuse_surface(step.pass.surfaces, index);
                const auto reservoir = chain.kernel.load_reservoir(resulting_set(step), index);
                if (!shared::is_valid(kept) || !(reservoir.weight > 0)) {
                    return;
                }
                const auto light = chain.kernel.see_light_point(reservoir.point, kept.position, shared::MOMENT_CURRENT);
                const float target = shared::unoccluded_target(shared::unpack_reuse_surface(kept, ~0U), light);
                wrong += std::abs(reservoir.target - target) <= 1e-6F * target ? 0 : 1;
                ++checked;
            });
            CAPTURE(frame, static_cast<int>(step.stage));
            CHECK(wrong == 0);
        });
    }
    CHECK(checked > 1000);
}

TEST_CASE("What a merge chooses keeps the favor that it came with") {
    RenderSettings settings = settings_of(Integrator::restir);
    settings.resampling.mis = GENERATE(ResamplingMis::pairwise, ResamplingMis::balance, ResamplingMis::one_over_z);
    settings.resampling.spatial_passes = 2;
    CAPTURE(static_cast<int>(settings.resampling.mis));
    Chain chain(generated("many-lights", 300), settings);
    int disfavored = 0;
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
        chain.run_frame(frame, [&](const ResamplingStep& step) {
            const bool temporal = step.stage == ResamplingStage::temporal;
            if (!temporal && step.stage != ResamplingStage::spatial) {
                return;
            }
            const std::uint32_t others = temporal ? step.pass.other_reservoirs : step.pass.reservoirs;
            std::map<PointKey, std::set<float>> came_with;
            chain.for_pixels([&](std::uint32_t index, shared::uvec2) {
                const auto reservoir = chain.kernel.load_reservoir(others, index);
                if (reservoir.weight > 0) {
                    came_with[key_of(reservoir.point)].insert(reservoir.favor);
                }
            });
            int wrong = 0;
            chain.for_pixels([&](std::uint32_t index, shared::uvec2) {
                const auto reservoir = chain.kernel.load_reservoir(resulting_set(step), index);
                if (!(reservoir.weight > 0)) {
                    return;
                }
                const auto found = came_with.find(key_of(reservoir.point));
                const std::set<float> expected = found == came_with.end() ? std::set<float>{1.0F} : found->second;
                wrong += expected.count(reservoir.favor) == 1 ? 0 : 1;
                disfavored += expected.size() == 1 && reservoir.favor == shared::FAVOR_HIDDEN ? 1 : 0;
            });
            CAPTURE(frame, static_cast<int>(step.stage), step.pass.iteration);
            CHECK(wrong == 0);
        });
    }
    CHECK(disfavored > 100);
}

TEST_CASE("Points that proved hidden give way to those that were seen") {
    for (const Scene& scene : {generated("many-lights", 300), generated("many-lights", 3000), slats(true)}) {
        const double without = share_hidden(scene, false);
        const double with = share_hidden(scene, true);
        std::printf("%s: hidden %.3f, %.3f where it is forgotten\n", scene.name.c_str(), with, without);
        CHECK(with < 0.97 * without);
    }
}

TEST_CASE("A picker that goes on from the sum over its clusters gives the densities of the one that made it") {
    Chain chain(generated("many-lights", 300), settings_of(Integrator::ris));
    const shared::ResamplingPass pass = chain.schedule.next_frame(0).front().pass;
    int near = 0;
    int differs = 0;
    chain.for_pixels([&](std::uint32_t, shared::uvec2 pixel) {
        chain.kernel.find_first_vertex(pixel, pass);
        const auto request = chain.kernel.resample_candidates(pixel, pass);
        const auto hit = chain.kernel.load_first_vertex(request.pixel).hit;
        const auto first = chain.kernel.load_first_surface(pixel, pass, hit);
        if (!first.takes_light) {
            return;
        }
        const auto surface = shared::unpack_reuse_surface(first.packed, ~0U);
        const auto made = chain.kernel.begin_candidate_picker(surface);
        const auto resumed = chain.kernel.resume_candidate_picker(surface, request);
        near += made.near > 0 ? 1 : 0;
        differs += made.close == resumed.close ? 0 : 1;
        for (std::uint32_t id = 0; id < chain.packed.constants.light_count; id += 7) {
            differs += chain.kernel.picks_of_light(made, id) == chain.kernel.picks_of_light(resumed, id) ? 0 : 1;
        }
    });
    CHECK(near > 100);
    CHECK(differs == 0);
}

}  // namespace diptych::core::tests
