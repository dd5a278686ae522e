// Merges of reservoirs, value by value: whom a pixel reuses, the weights of each kind of MIS, and what is handed on.
#include <array>

#include "backend/resampling_stages.h"
#include "../cpu/test_kernel.h"
#include "chain_cases.h"

namespace diptych::core::tests {
namespace {

struct Frame {
    PackedScene packed;
    EmbreeScene embree;
    ResamplingFilms films;
    Kernel kernel;
    ResamplingSchedule schedule;

    Frame(const Scene& scene, const RenderSettings& settings)
        : packed(pack_scene(scene, settings)), embree(packed),
          films(packed.constants), kernel{packed, packed.constants, {{embree}}, &films}, schedule(packed.constants) {}

    /// The stages of a frame up to `last`; `before` it, the test may look on and change what there is.
    template <class Before>
    ResamplingStep run(std::uint32_t frame, ResamplingStage last, Before&& before) {
        for (const ResamplingStep& step : schedule.next_frame(frame)) {
            if (step.stage == last) {
                before(step);
            }
            for (std::uint32_t i = 0; i < films.pixels; ++i) {
                run_stage(kernel, step, {i % packed.constants.size.x, i / packed.constants.size.x});
            }
            if (step.stage == last) {
                return step;
            }
        }
        return {};
    }
};

RenderSettings restir_settings(int width, int height) {
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    settings.integrator = Integrator::restir;
    settings.max_depth = 1;
    return settings;
}

/// A floor that is alike everywhere, from above.
Scene floor_from_above() {
    Scene scene;
    const int floor = add_material(scene, diffuse_material(0.5F));
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(1)));
    add_object(scene, "room", {horizontal_square({0, 0, 0}, 9, true, floor), horizontal_square({0, 9, 0}, 1, false, lamp)});
    scene.cameras.push_back(make_camera("eye", {0, 5, 0.01}, {0, 0, 0}, 60));
    return scene;
}

/// p̂ of a reservoir's point at the surface of pixel `index`.
double target_at(Frame& frame, std::uint32_t surfaces, std::uint32_t index, const shared::LightPoint& point) {
    const shared::TargetSurface s = shared::unpack_reuse_surface(frame.kernel.load_reuse_surface(surfaces, index), ~0U);
    return static_cast<double>(
        shared::unoccluded_target(s, frame.kernel.see_light_point(point, s.position, shared::MOMENT_CURRENT)));
}

struct Merged {
    double confidence;
    double p_hat_w;  // of what is chosen; in the biased forms and with 1/Z it depends on which that is
};

/// By the papers' formulas, in double. `pixels`: the canonical one first.
Merged expected_merge(Frame& frame, std::uint32_t mis, std::uint32_t surfaces, const std::array<std::uint32_t, 4>& pixels,
                      const std::array<shared::Reservoir, 4>& r, const shared::LightPoint& chosen) {
    const auto p = [&](std::size_t j, const shared::LightPoint& y) { return target_at(frame, surfaces, pixels[j], y); };
    const auto c = [&](std::size_t j) { return static_cast<double>(r[j].confidence); };
    const double total = c(0) + c(1) + c(2) + c(3);
    const double others = total - c(0);
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        if (!(r[i].weight > 0)) {
            continue;
        }
        const shared::LightPoint& y = r[i].point;
        double share = c(i);
        if (mis == shared::RESAMPLING_BALANCE) {
            share = c(i) * p(i, y) / (c(0) * p(0, y) + c(1) * p(1, y) + c(2) * p(2, y) + c(3) * p(3, y));
        } else if (mis == shared::RESAMPLING_PAIRWISE && i > 0) {
            share = c(i) / total * (others * p(i, y) / (others * p(i, y) + c(0) * p(0, y)));
        } else if (mis == shared::RESAMPLING_PAIRWISE) {
            share = c(0) / total;
            for (std::size_t j = 1; j < 4; ++j) {
                share += c(j) / total * (c(0) * p(0, y) / (c(0) * p(0, y) + others * p(j, y)));
            }
        }
        sum += share * p(0, y) * static_cast<double>(r[i].weight);
    }
    double confidence_of_makers = 0;
    for (std::size_t j = 0; j < 4; ++j) {
        confidence_of_makers += p(j, chosen) > 0 ? c(j) : 0;
    }
    const bool by_confidence = mis == shared::RESAMPLING_ONE_OVER_Z || mis == shared::RESAMPLING_BIASED_ONE_OVER_M;
    const double divisor = mis == shared::RESAMPLING_ONE_OVER_Z ? confidence_of_makers : by_confidence ? total : 1;
    return {total, sum / divisor};
}

}  // namespace

TEST_CASE("Spatial neighbours lie uniformly on the disk of the radius") {
    RenderSettings settings = restir_settings(64, 48);
    settings.resampling.temporal = false;
    settings.resampling.neighbors = 1;
    settings.resampling.radius = 10;
    Frame chain(floor_from_above(), settings);
    glm::dvec2 mean(0);
    glm::dmat2 squares(0);
    double farthest = 0;
    int count = 0;
    for (std::uint32_t frame = 0; frame < 6; ++frame) {
        // Reservoirs whose confidence names the pixel: what a merge adds to its own is the neighbour's.
        const ResamplingStep step = chain.run(frame, ResamplingStage::spatial, [&](const ResamplingStep& s) {
            for (std::uint32_t i = 0; i < chain.films.pixels; ++i) {
                shared::Reservoir r = shared::empty_reservoir();
                r.confidence = static_cast<float>(i + 1);
                chain.kernel.store_reservoir(s.pass.reservoirs, i, r);
            }
        });
        for (std::uint32_t y = 11; y < 48 - 11; ++y) {
            for (std::uint32_t x = 11; x < 64 - 11; ++x) {
                const std::uint32_t own = 64 * y + x;
                const auto added = static_cast<std::uint32_t>(chain.kernel.load_reservoir(resulting_set(step), own).confidence) - (own + 1);
                const std::uint32_t other = added == 0 ? own : added - 1;  // a pixel does not merge with itself
                const glm::dvec2 offset(static_cast<int>(other % 64) - static_cast<int>(x), static_cast<int>(other / 64) - static_cast<int>(y));
                mean += offset;
                squares += glm::outerProduct(offset, offset);
                farthest = std::max(farthest, glm::length(offset));
                ++count;
            }
        }
    }
    // r^2 / 4 an axis, and 1 / 12 from rounding to pixels; five standard errors.
    const double expected = 100.0 / 4 + 1.0 / 12;
    const double error = 25.0 / std::sqrt(count);
    CHECK(std::abs(squares[0][0] / count - expected) < 5 * error);
    CHECK(std::abs(squares[1][1] / count - expected) < 5 * error);
    CHECK(std::abs(squares[0][1] / count) < 5 * error);
    CHECK(glm::length(mean / static_cast<double>(count)) < 5 * std::sqrt(2 * expected / count));
    CHECK(farthest <= 10.8);
    CHECK(farthest > 9);
}

TEST_CASE("The neighbours of a pixel are drawn independently of each other") {
    RenderSettings settings = restir_settings(64, 48);
    settings.resampling.temporal = false;
    settings.resampling.neighbors = 4;
    settings.resampling.radius = 10;
    Frame chain(floor_from_above(), settings);
    // Confidences of a thousand and the column: what a merge adds to its own tells how many neighbours there are and how far aside all
    // together.
    const ResamplingStep step = chain.run(0, ResamplingStage::spatial, [&](const ResamplingStep& s) {
        for (std::uint32_t i = 0; i < chain.films.pixels; ++i) {
            shared::Reservoir r = shared::empty_reservoir();
            r.confidence = static_cast<float>(1000 + i % 64);
            chain.kernel.store_reservoir(s.pass.reservoirs, i, r);
        }
    });
    double squares = 0;
    int neighbors = 0;
    int pixels = 0;
    for (int y = 11; y < 48 - 11; ++y) {
        for (int x = 11; x < 64 - 11; ++x) {
            const auto merged = static_cast<int>(chain.kernel.load_reservoir(resulting_set(step), static_cast<std::uint32_t>(64 * y + x)).confidence);
            const int added = merged - (1000 + x);
            const int count = added / 1000;
            const int aside = added - count * (1000 + x);
            squares += aside * aside;
            neighbors += count;
            ++pixels;
        }
    }
    CHECK(neighbors > 3.9 * pixels);
    // The variance of a sum of independent offsets is the sum of theirs, r^2 / 4 and 1 / 12 from rounding to pixels; five standard errors.
    const double expected = 100.0 / 4 + 1.0 / 12;
    CHECK(std::abs(squares / neighbors - expected) < 5 * std::sqrt(2.0 / pixels) * expected);
}

TEST_CASE("A disk within the pixel itself holds no neighbours") {
    RenderSettings settings = restir_settings(64, 48);
    settings.resampling.temporal = false;
    settings.resampling.radius = 0.499F;
    Frame chain(floor_from_above(), settings);
    const ResamplingStep step = chain.run(0, ResamplingStage::spatial, [&](const ResamplingStep& s) {
        for (std::uint32_t i = 0; i < chain.films.pixels; ++i) {
            shared::Reservoir r = shared::empty_reservoir();
            r.confidence = 1;
            chain.kernel.store_reservoir(s.pass.reservoirs, i, r);
        }
    });
    int with_others = 0;
    for (std::uint32_t i = 0; i < chain.films.pixels; ++i) {
        with_others += chain.kernel.load_reservoir(resulting_set(step), i).confidence == 1 ? 0 : 1;
    }
    CHECK(with_others == 0);
}

TEST_CASE("A place on the film is within its width and its height") {
    Frame chain(floor_from_above(), restir_settings(64, 48));
    const shared::uvec2 size(64, 48);
    for (const auto& [place, inside] : {std::pair{glm::vec2(0, 0), true}, {{63, 47}, true}, {{64, 0}, false}, {{0, 48}, false},
                                        {{63, 0}, true}, {{0, 47}, true}, {{-1, 5}, false}, {{5, -1}, false}}) {
        CAPTURE(place.x, place.y);
        CHECK(chain.kernel.is_inside(place, size) == inside);
    }
}

TEST_CASE("A merge has the weight of its MIS by the papers' formulas, whatever is chosen, null samples included") {
    RenderSettings settings = restir_settings(32, 24);
    settings.resampling.mis =
        GENERATE(ResamplingMis::pairwise, ResamplingMis::balance, ResamplingMis::one_over_z, ResamplingMis::biased_one_over_m);
    const auto mis = static_cast<std::uint32_t>(settings.resampling.mis);
    CAPTURE(mis);
    Frame chain(generated("veach-mis"), settings);
    const ResamplingStep step = chain.run(0, ResamplingStage::candidates, [](const ResamplingStep&) {});
    int merges = 0;
    int wrong = 0;
    for (std::uint32_t i = 0; i + 300 < chain.films.pixels; i += 5) {
        const std::array<std::uint32_t, 4> pixels{i, i + 1, i + 66, i + 300};
        Kernel::Neighborhood others{};
        others.reservoir_set = step.pass.reservoirs;
        others.surface_set = step.pass.surfaces;
        others.moment = shared::MOMENT_CURRENT;
        others.confidence_cap = 6;
        std::array<shared::Reservoir, 4> reservoirs{};
        bool all_valid = true;
        for (std::uint32_t j = 0; j < 4; ++j) {
            shared::Reservoir r = chain.kernel.load_reservoir(step.pass.reservoirs, pixels[j]);
            r.confidence = static_cast<float>(1 + 3 * j);
            r.weight = j == 2 && i % 2 == 0 ? 0 : r.weight;
            reservoirs[j] = r;
            reservoirs[j].confidence = j > 0 ? std::min(r.confidence, others.confidence_cap) : r.confidence;
            chain.kernel.store_reservoir(step.pass.reservoirs, pixels[j], r);
            all_valid = all_valid && shared::is_valid(chain.kernel.load_reuse_surface(step.pass.surfaces, pixels[j]));
            if (j > 0) {
                others.pixels[others.count++] = pixels[j];
            }
        }
        if (!all_valid) {
            continue;
        }
        const shared::TargetSurface surface = shared::unpack_reuse_surface(chain.kernel.load_reuse_surface(step.pass.surfaces, i), ~0U);
        const shared::Sampler random = shared::make_sampler({i, 0}, 9, 1, shared::SAMPLER_INDEPENDENT, 16);
        shared::uint rays = 0;
        const shared::Reservoir merged = chain.kernel.merge_reservoirs(surface, reservoirs[0], others, random, shared::DIMENSION_NEIGHBOR_PICK, rays);
        const Merged expected = expected_merge(chain, mis, step.pass.surfaces, pixels, reservoirs, merged.point);
        wrong += static_cast<double>(merged.confidence) == Approx(expected.confidence) ? 0 : 1;
        wrong += rays == 0 ? 0 : 1;
        if (merged.weight > 0) {
            const double p_hat_w = static_cast<double>(merged.weight) * target_at(chain, step.pass.surfaces, i, merged.point);
            wrong += p_hat_w == Approx(expected.p_hat_w).epsilon(1e-4) ? 0 : 1;
            ++merges;
        }
    }
    CHECK(merges > 40);
    CHECK(wrong == 0);
}

TEST_CASE("What proves hidden in the end is handed on with less favor, or dropped where visibility is biased_final") {
    for (const auto visibility : {ResamplingVisibility::shading, ResamplingVisibility::biased_final}) {
        RenderSettings settings = restir_settings(32, 24);
        settings.resampling.visibility = visibility;
        Frame chain(slats(false), settings);
        std::vector<shared::Reservoir> before;
        const ResamplingStep step = chain.run(0, ResamplingStage::shadows, [&](const ResamplingStep& s) {
            for (std::uint32_t i = 0; i < chain.films.pixels; ++i) {
                before.push_back(chain.kernel.load_reservoir(resulting_set(s), i));
            }
        });
        std::array<int, 2> count{};
        for (std::uint32_t i = 0; i < chain.films.pixels; ++i) {
            if (!(before[i].weight > 0)) {
                continue;
            }
            const auto after = chain.kernel.load_reservoir(resulting_set(step), i);
            const bool hidden = chain.kernel.load_first_vertex(i).occluded != 0;
            const bool dropped = hidden && visibility == ResamplingVisibility::biased_final;
            ++count.at(hidden ? 1 : 0);
            REQUIRE(after.weight == (dropped ? 0 : before[i].weight));
            REQUIRE(after.favor == (hidden ? shared::FAVOR_HIDDEN : 1.0F));
            REQUIRE(after.confidence == before[i].confidence);
        }
        CHECK(count[0] > 50);
        CHECK(count[1] > 50);
    }
}

}  // namespace diptych::core::tests
