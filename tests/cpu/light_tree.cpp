// Picks of lights by the shared kernel: their frequencies against the probabilities that they state, and both against
// what a hit on the light is weighed by.
#include "generate/generate.h"
#include "numbers/rng.h"
#include "render_fixture.h"
#include "stats/chi_square.h"
#include "test_kernel.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

struct Fixture {
    PackedScene packed;
    EmbreeScene embree;
    Kernel kernel;

    Fixture(const Scene& scene, LightSampler sampler)
        : packed(pack_scene(scene, settings(sampler))), embree(packed),
          kernel{packed, packed.constants, {{embree}}} {}

    static RenderSettings settings(LightSampler sampler) {
        RenderSettings s = statistical_settings(4, 4, Integrator::path, 1);
        s.light_sampler = sampler;
        return s;
    }
};

Scene street() {
    GenerateOptions options;
    options.count = 60;
    Scene scene = generate_scene("many-lights", options).scene;
    PunctualLight point;
    point.light_to_world[3] = {1, 2, 3, 1};
    point.intensity = glm::vec3(5);
    PunctualLight sun;
    sun.type = PunctualType::directional;
    sun.intensity = glm::vec3(0.3F);
    scene.lights = {point, sun};
    scene.environment.kind = Environment::Kind::constant;
    scene.environment.scale = glm::vec3(0.2F);
    return scene;
}

}  // namespace

TEST_CASE("Lights are picked as often as their probabilities say, and a hit on one is weighed by the same") {
    for (const LightSampler sampler : {LightSampler::uniform, LightSampler::power, LightSampler::spatial}) {
        Fixture f(street(), sampler);
        const shared::uint lights = f.packed.constants.light_count;
        REQUIRE(lights == f.packed.emissive_triangles.size() + 3);
        const glm::vec3 references[] = {{0, 0.2F, 0}, {3, 1, -2}, {-20, 5, 40}};
        const glm::vec3 normals[] = {{0, 1, 0}, {0.6F, 0, 0.8F}};
        for (const glm::vec3& reference : references) {
            for (const glm::vec3& normal : normals) {
                CAPTURE(name_of(sampler), reference.x, normal.x);
                const shared::uint facing = shared::pack_facing(normal);
                constexpr int draws = 1 << 18;
                std::vector<double> observed(lights, 0);
                for (shared::uint i = 0; i < draws; ++i) {
                    shared::FourPairs words{};
                    const shared::uvec4 bits = shared::pcg4d(shared::uvec4(i, 1, 2, 3));
                    words.first.z = bits.x;
                    words.second.z = bits.y;
                    const shared::LightPick pick = f.kernel.pick_light(reference, facing, words);
                    if (pick.id == shared::NONE) {
                        continue;  // its back: not weighed below
                    }
                    observed[pick.id] += 1;
                    const float stated =
                        f.kernel.pick_probability(pick.id, f.kernel.power_probability(pick.id), reference, facing);
                    CHECK(static_cast<double>(pick.pmf) == Approx(static_cast<double>(stated)).epsilon(2e-6));
                }
                double sum = 0;
                std::vector<double> expected;
                std::vector<double> kept;
                double rest = draws;
                double others = draws;
                for (shared::uint id = 0; id < lights; ++id) {
                    const auto p = static_cast<double>(
                        f.kernel.pick_probability(id, f.kernel.power_probability(id), reference, facing));
                    sum += p;
                    const bool behind = id < f.packed.emissive_triangles.size() &&
                                        f.kernel.is_behind(f.packed.emissive_triangles[id], reference);
                    if (!behind && p * draws > 5) {
                        expected.push_back(p * draws);
                        kept.push_back(observed[id]);
                        rest -= expected.back();
                        others -= observed[id];
                    }
                }
                CHECK(sum == Approx(1).epsilon(1e-5));
                expected.push_back(rest);
                kept.push_back(others);
                CHECK(chi_square_fit(kept, expected).p > 1e-5);
            }
        }
    }
}

TEST_CASE("Light that a path finds by chance is weighed by the tree's probability at the vertex before") {
    Fixture f(street(), LightSampler::spatial);
    const glm::vec3 reference(0, 0.2F, 0);
    const shared::uint facing = shared::pack_facing({0, 1, 0});
    const glm::vec3 up = glm::normalize(glm::vec3(0.1F, 1, 0.2F));
    const shared::uint sky = f.kernel.environment_light();
    const float pmf = f.kernel.probability_from_tree(sky, reference, facing);
    CHECK(pmf > 0);
    CHECK(static_cast<double>(f.kernel.pdf_light_of_miss(up, reference, facing)) ==
          Approx(static_cast<double>(pmf) / (4 * 3.14159265358979)).epsilon(1e-5));
    // Nothing but the first vertex and its normal decide: elsewhere another probability.
    CHECK(pmf != f.kernel.probability_from_tree(sky, reference, shared::pack_facing({0, -1, 0})));
}

TEST_CASE("Pictures are the same whatever picks the lights") {
    for (const Integrator integrator : {Integrator::path, Integrator::direct}) {
        for (const char* name : {"veach-mis", "many-lights"}) {
            GenerateOptions options;
            options.count = 20;
            const Scene scene = generate_scene(name, options).scene;
            const auto rendered = [&](LightSampler sampler) {
                RenderSettings settings = statistical_settings(24, 24, integrator, 2);
                settings.light_sampler = sampler;
                settings.seed += static_cast<std::uint32_t>(sampler);
                return image_mean(render_cpu(scene, settings, 256));
            };
            const ImageMean power = rendered(LightSampler::power);
            for (const LightSampler sampler : {LightSampler::uniform, LightSampler::spatial}) {
                const ImageMean other = rendered(sampler);
                CAPTURE(name, name_of(integrator), name_of(sampler), power.mean[0], other.mean[0]);
                CHECK(worst_z(power, other) < 4.5);
                CHECK(other.nonfinite == 0);
            }
        }
    }
}
