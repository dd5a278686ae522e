// Light points of initial reservoirs are as the target is: the mean of p̂ W over a part of the lights is the target's integral over that
// part, which plain quadrature tells. A choice that depends on what it chooses from would show here, though sums stay right.
#include <functional>

#include "backend/resampling_stages.h"
#include "../cpu/test_kernel.h"
#include "chain_cases.h"

namespace diptych::core::tests {
namespace {

constexpr std::size_t parts = 4;
using Part = std::function<std::size_t(const shared::LightPoint&, double target)>;

/// A floor under square lamps, seen in one point.
Scene floor_under(const Material& floor, const std::vector<Primitive>& lamps, const glm::dvec3& eye) {
    Scene scene;
    const int material = add_material(scene, floor);
    add_material(scene, make_emitter("lamp", glm::vec3(1)));
    std::vector<Primitive> all{horizontal_square({0, 0, 0}, 2, true, material)};
    all.insert(all.end(), lamps.begin(), lamps.end());
    add_object(scene, "room", all);
    scene.cameras.push_back(point_camera(eye, {0, 0, 0}));
    return scene;
}

void check_distribution(const Scene& scene, Integrator integrator, std::uint32_t samples, const Part& part_of,
                        const ResamplingSettings& resampling = {}) {
    RenderSettings settings;
    settings.resampling = resampling;
    settings.width = 1;
    settings.height = 1;
    settings.integrator = integrator;
    settings.max_depth = 1;
    const PackedScene packed = pack_scene(scene, settings);
    const EmbreeScene embree(packed);
    ResamplingFilms films(packed.constants);
    Kernel kernel{packed, packed.constants, {{embree}}, &films};
    ResamplingSchedule schedule(packed.constants);
    ResamplingStep step = schedule.next_frame(0).front();
    kernel.find_first_vertex({0, 0}, step.pass);
    const auto first = kernel.load_first_surface({0, 0}, step.pass, kernel.load_first_vertex(0).hit);
    REQUIRE(first.takes_light);
    const auto target_of = [&](const shared::LightPoint& y) {
        const auto light = kernel.see_light_point(y, first.origin, shared::MOMENT_CURRENT);
        const shared::vec3 f = shared::surface_bsdf_eval(first.bsdf, first.wo, light.direction, kernel.features());
        return static_cast<double>(kernel.candidate_target(first, light, f));
    };
    double brightest = 0;
    std::array<double, parts> truth{};
    for (const bool summing : {false, true}) {
        constexpr int n = 400;
        for (std::uint32_t id = 0; id < packed.constants.light_count; ++id) {
            for (int i = 0; i < n; ++i) {
                for (int j = 0; i + j < n; ++j) {
                    shared::LightPoint y;
                    y.light = id;
                    y.uv = glm::vec2((static_cast<float>(i) + 1.0F / 3) / n, (static_cast<float>(j) + 1.0F / 3) / n);
                    const double target = target_of(y);
                    brightest = std::max(brightest, target);
                    if (summing) {
                        truth.at(part_of(y, target / brightest)) += target * (i + j + 1 == n ? 0.5 : 1.0) / (n * n);
                    }
                }
            }
        }
    }
    std::array<double, parts> sum{};
    std::array<double, parts> squares{};
    step.stage = ResamplingStage::candidates;
    for (std::uint32_t frame = 0; frame < samples; ++frame) {
        step.pass.frame = frame;
        kernel.find_first_vertex({0, 0}, step.pass);
        run_stage(kernel, step, {0, 0});
        const shared::Reservoir r = kernel.load_reservoir(step.pass.reservoirs, 0);
        if (r.weight > 0) {
            const double x = static_cast<double>(r.weight) * static_cast<double>(r.target);
            const std::size_t part = part_of(r.point, static_cast<double>(r.target) / brightest);
            sum.at(part) += x;
            squares.at(part) += x * x;
        }
    }
    for (std::size_t k = 0; k < parts; ++k) {
        const double mean = sum.at(k) / samples;
        const double error = std::sqrt(std::max(squares.at(k) / samples - mean * mean, 0.0) / samples) + 2e-3 * truth.at(k);
        CAPTURE(name_of(integrator), k, mean, truth.at(k), error);
        if (truth.at(k) > 0) {
            CHECK(error < 0.02 * truth.at(k));
        }
        CHECK(std::abs(mean - truth.at(k)) <= 5 * error);
    }
}

}  // namespace

TEST_CASE("Each of four lamps gets the share of a reservoir's light that quadrature says, on a diffuse floor") {
    const Scene scene = floor_under(diffuse_material(0.7F),
                                    {horizontal_square({0.9F, 1, 0}, 0.2F, false, 1), horizontal_square({-0.5F, 0.6F, 0.4F}, 0.1F, false, 1),
                                     horizontal_square({0, 1.5F, -1}, 0.3F, false, 1), horizontal_square({0.5F, 0.5F, 0.7F}, 0.15F, false, 1)},
                                    {0.3, 1, 1});
    for (const Integrator integrator : {Integrator::ris, Integrator::restir}) {
        check_distribution(scene, integrator, 40000, [](const shared::LightPoint& y, double) { return y.light / 2; });
    }
}

TEST_CASE("A small lamp close by gets the share that quadrature says, though the diffuse floor looks for it one time in eight") {
    std::vector<Primitive> lamps{horizontal_square({0.03F, 0.02F, 0}, 0.03F, false, 1)};
    for (const float x : {-2.2F, 0.0F, 2.2F}) {
        lamps.push_back(horizontal_square({x, 2, 1.1F}, 1, false, 1));
        lamps.push_back(horizontal_square({x, 2, -1.1F}, 1, false, 1));
    }
    const Scene scene = floor_under(diffuse_material(0.7F), lamps, {-0.3, 1, 0.2});
    ResamplingSettings by_power;
    by_power.near_share = 0;  // so that picks seldom find it
    for (const Integrator integrator : {Integrator::ris, Integrator::restir}) {
        check_distribution(
            scene, integrator, 60000, [](const shared::LightPoint& y, double) { return y.light < 2 ? 0U : 1U; }, by_power);
    }
}

TEST_CASE("A lamp's dim and bright parts get the shares that quadrature says, in narrow lobes and wide ones") {
    for (const float roughness : {0.2F, 0.5F}) {
        CAPTURE(roughness);
        const Scene scene = floor_under(make_material("floor", glm::vec3(0.9F), 1, roughness), {horizontal_square({0, 1, -1}, 0.5F, false, 1)},
                                        {0, 1, 1});
        for (const Integrator integrator : {Integrator::ris, Integrator::restir}) {
            check_distribution(scene, integrator, 40000, [](const shared::LightPoint&, double of_brightest) {
                return of_brightest > 0.7 ? 0U : of_brightest > 0.3 ? 1U : of_brightest > 0.05 ? 2U : 3U;
            });
        }
    }
}

}  // namespace diptych::core::tests
