// Picks of lights follow the density that candidates are weighed by.
#include "../cpu/test_kernel.h"
#include "chain_cases.h"
#include "stats/chi_square.h"

namespace diptych::core::tests {
namespace {

shared::TargetSurface surface_at(const glm::vec3& position, const glm::vec3& normal) {
    shared::TargetSurface s{};
    s.position = position;
    s.normal = normal;
    return s;
}

}  // namespace

TEST_CASE("Lights are picked as often as their density says, near and far") {
    Scene scene = generated("many-lights", 300);
    PunctualLight point;
    point.light_to_world[3] = {0.5, 1, 0.5, 1};
    point.intensity = glm::vec3(1);
    PunctualLight sun;
    sun.type = PunctualType::directional;
    scene.lights = {point, sun};
    RenderSettings settings;
    settings.width = 8;
    settings.height = 8;
    settings.integrator = Integrator::ris;
    const PackedScene packed = pack_scene(scene, settings);
    const EmbreeScene embree(packed);
    Kernel kernel{packed, packed.constants, {{embree}}};
    const std::size_t lights = packed.light_table.size();
    REQUIRE(packed.constants.resampling.near_candidates == 4);
    const glm::vec3 beside = packed.emissive_triangles[7].vertex_0;
    for (const glm::vec3& position : {beside, beside + glm::vec3(0.1F, -0.3F, 0.2F), glm::vec3(0, 500, 0)}) {
        const glm::vec3 normal(0, position.y > 100 ? -1 : 1, 0);
        const auto picker = kernel.begin_candidate_picker(surface_at(position, normal));
        REQUIRE(picker.near == 4);
        constexpr std::uint32_t samples = 100000;
        std::vector<double> observed(lights, 0);
        int differs = 0;
        for (std::uint32_t i = 0; i < samples; ++i) {
            const shared::Sampler random = shared::make_sampler({3, 5}, i, 1, shared::SAMPLER_INDEPENDENT, samples);
            auto steps = kernel.begin_cluster_steps(random);
            for (std::uint32_t step = 0; step < picker.near; ++step) {
                const glm::uvec4 w = shared::independent_words(random, shared::DIMENSION_CANDIDATE + step);
                const auto picked = kernel.pick_near_light(steps, picker, step, {w.x, w.y, w.z});
                observed[picked.id] += 1;
                differs += picked.picks == kernel.picks_of_light(picker, picked.id) ? 0 : 1;
            }
        }
        CHECK(differs == 0);
        std::vector<double> expected(lights, 0);
        double sum = 0;
        for (std::uint32_t id = 0; id < lights; ++id) {
            const std::size_t emitters = packed.emissive_triangles.size();
            const float pmf =
                id < emitters ? packed.emissive_triangles[id].pmf : packed.punctual_lights[id - emitters].pmf;
            const double near = static_cast<double>(kernel.picks_of_light(picker, id)) - picker.by_power;
            expected[id] = samples * near * static_cast<double>(pmf);
            sum += expected[id];
        }
        CHECK(sum == Approx(4.0 * samples).epsilon(1e-4));
        // Systematic steps pick no light more evenly than that, and none less evenly.
        const ChiSquareFit fit = chi_square_fit(observed, expected);
        INFO(fit.statistic << " of " << fit.freedom);
        CHECK(fit.freedom > 2);
        CHECK(chi_square_deviate(fit) < deviate_limit);
    }
}

TEST_CASE("A dim lamp is found beside itself, though bright ones share its cluster") {
    Scene scene = generated("many-lights", 300);
    for (Material& material : scene.materials) {
        if (material.name == "light 1") {
            material.emission *= 1000.0F;
        }
    }
    RenderSettings settings;
    settings.width = 8;
    settings.height = 8;
    settings.integrator = Integrator::ris;
    const PackedScene packed = pack_scene(scene, settings);
    const EmbreeScene embree(packed);
    Kernel kernel{packed, packed.constants, {{embree}}};
    float dimmest = 1;
    for (std::uint32_t id = 0; id < packed.emissive_triangles.size(); ++id) {
        const shared::EmissiveTriangle& light = packed.emissive_triangles[id];
        // A little in front of it, looking back.
        const glm::vec3 middle = light.vertex_0 + (light.edge_1 + light.edge_2) / 3.0F;
        const float aside = std::sqrt(light.double_area);
        const auto picker = kernel.begin_candidate_picker(surface_at(middle + aside * light.front, -light.front));
        dimmest = std::min(dimmest, light.pmf);
        INFO(id << ": by power " << 8 * light.pmf);
        CHECK(kernel.picks_of_light(picker, id) * light.pmf > 0.05F);
    }
    CHECK(dimmest < 1e-3F);
}

TEST_CASE("As many lights are picked near as asked for, from one on, the rest by power, and densities add up to all picks") {
    for (std::uint32_t near = 0; near <= 4; ++near) {
        RenderSettings settings;
        settings.width = 8;
        settings.height = 8;
        settings.integrator = Integrator::ris;
        settings.resampling.light_candidates = 8;
        settings.resampling.near_share = static_cast<float>(near) / 8;
        Scene scene = generated("many-lights", 300);
        PunctualLight bulb;
        bulb.light_to_world[3] = {0.5, 1, 0.5, 1};
        PunctualLight sun;
        sun.type = PunctualType::directional;
        scene.lights = {bulb, sun};
        const PackedScene packed = pack_scene(scene, settings);
        const EmbreeScene embree(packed);
        Kernel kernel{packed, packed.constants, {{embree}}};
        CAPTURE(near);
        for (const glm::vec3& place : {packed.emissive_triangles[7].vertex_0, packed.punctual_lights[0].position - glm::vec3(0, 0.2F, 0)}) {
            const auto picker = kernel.begin_candidate_picker(surface_at(place, {0, 1, 0}));
            CHECK(picker.near == near);
            CHECK(picker.by_power == 8 - near);
            CHECK((picker.sum > 0) == (near > 0));
            double picks = 0;
            int fewer = 0;
            int more = 0;
            for (std::uint32_t id = 0; id < packed.constants.light_count; ++id) {
                const std::size_t emitters = packed.emissive_triangles.size();
                const float pmf = id < emitters ? packed.emissive_triangles[id].pmf : packed.punctual_lights[id - emitters].pmf;
                const float density = kernel.picks_of_light(picker, id);
                picks += static_cast<double>(pmf) * static_cast<double>(density);
                fewer += density >= static_cast<float>(8 - near) ? 0 : 1;
                more += density > static_cast<float>(8 - near) ? 1 : 0;
            }
            CHECK(picks == Approx(8).epsilon(1e-4));
            CHECK(fewer == 0);
            CHECK((more > 0) == (near > 0));
        }
    }
}

TEST_CASE("A cluster's parts are told apart within two radii of it, if it has several lights") {
    RenderSettings settings;
    settings.width = 8;
    settings.height = 8;
    settings.integrator = Integrator::ris;
    const PackedScene packed = pack_scene(generated("many-lights", 300), settings);
    const EmbreeScene embree(packed);
    Kernel kernel{packed, packed.constants, {{embree}}};
    int told = 0;
    for (std::uint32_t cluster = 0; cluster < packed.constants.light_cluster_count; ++cluster) {
        const shared::LightCluster& whole = packed.light_clusters[cluster];
        for (const float radii : {0.0F, 1.9F, 2.1F}) {
            const glm::vec3 up(0, 1, 0);
            const auto picker = kernel.begin_candidate_picker(surface_at(whole.center - radii * whole.radius * up, up));
            double sum = 0;
            for (std::uint32_t i = 0; i < shared::PARTS_PER_CLUSTER; ++i) {
                sum += static_cast<double>(kernel.cluster_weight(picker, kernel.load_cluster_part(cluster, i)));
            }
            const bool tells = whole.count > 1 && radii < 2;
            CAPTURE(cluster, whole.count, radii);
            CHECK(kernel.parts_sum(picker, cluster, whole) == Approx(tells ? sum : 0).epsilon(1e-5));
            told += tells && sum > 0 ? 1 : 0;
        }
    }
    CHECK(told > 10);
}

TEST_CASE("An emitter is within reach beside any of them, and none is far from all") {
    RenderSettings settings;
    settings.width = 8;
    settings.height = 8;
    settings.integrator = Integrator::ris;
    const PackedScene packed = pack_scene(generated("many-lights", 300), settings);
    const EmbreeScene embree(packed);
    Kernel kernel{packed, packed.constants, {{embree}}};
    REQUIRE(packed.constants.light_cluster_count > 1);
    REQUIRE(kernel.light_reach() > 0);
    int far = 0;
    for (const shared::EmissiveTriangle& light : packed.emissive_triangles) {
        const glm::vec3 beside = light.vertex_0 + 0.5F * kernel.light_reach() * light.front;
        far += kernel.begin_candidate_picker(surface_at(beside, -light.front)).close ? 0 : 1;
    }
    CHECK(far == 0);
    CHECK(!kernel.begin_candidate_picker(surface_at({0, 500, 0}, {0, -1, 0})).close);
}

TEST_CASE("Materials are sampled for lights twice where their lobe is narrow, and where emitters are close, once or now and then") {
    RenderSettings settings;
    settings.width = 8;
    settings.height = 8;
    settings.integrator = Integrator::ris;
    PackedScene packed = pack_scene(generated("many-lights", 300), settings);
    packed.features |= shared::FEATURE_MIRRORS;
    const EmbreeScene embree(packed);
    Kernel kernel{packed, packed.constants, {{embree}}};
    auto picker = kernel.begin_candidate_picker(surface_at(packed.emissive_triangles[7].vertex_0, {0, 1, 0}));
    const glm::vec3 white(1);
    for (const bool close : {false, true}) {
        picker.close = close;
        const auto sampled = [&](float alpha, float specular) {
            shared::SurfaceBsdf bsdf{};
            bsdf.parameters = shared::bsdf_parameters(white, 0, std::sqrt(alpha), 0.04F, specular, white, shared::BRDF_GGX);
            const auto c = kernel.bsdf_candidates(bsdf, picker);
            return std::pair(c.count, c.reach);
        };
        const float reach = kernel.light_reach();
        CAPTURE(close);
        CHECK(sampled(0.09F, 1) == std::pair(2.0F, shared::INFINITE_DISTANCE));
        CHECK(sampled(0.11F, 1) == std::pair(close ? 1.0F : 0.0F, reach));
        CHECK(sampled(0.49F, 1) == std::pair(close ? 1.0F : 0.0F, reach));
        CHECK(sampled(0.51F, 1) == std::pair(close ? 0.125F : 0.0F, reach));
        CHECK(sampled(0.09F, 0) == std::pair(close ? 0.125F : 0.0F, reach));  // nothing reflects
        CHECK(sampled(0, 1) == std::pair(close ? 0.125F : 0.0F, reach));      // a mirror shows lights without that
    }
}

}  // namespace diptych::core::tests
