// The three integrators, both MIS heuristics and all samplers share one expectation.
#include <cstdio>

#include "agreement_scenes.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// Checks that every integrator has the mean of `path`, by films of one seed. `least` is the relative error that must
/// be reached, so that agreement says something.
void check_integrators(const std::string& name, const Scene& scene, BrdfModel brdf, std::uint32_t spp, double least) {
    std::array<Film, 3> films;
    for (std::size_t i = 0; i < 3; ++i) {
        RenderSettings settings = statistical_settings(32, 24, integrators[i], 5);
        settings.standard_error = false;
        settings.brdf = brdf;
        settings.seed = 7;
        films[i] = render_cpu(scene, settings, spp);
        INFO(name << " " << name_of(integrators[i]));
        CHECK(film_totals(films[i]).nonfinite == 0);
    }
    for (std::size_t i = 0; i < 2; ++i) {
        const PairedDifference d = paired_difference(films[i], films[2]);
        INFO(name << ", " << name_of(brdf) << ", " << name_of(integrators[i]) << ": z " << d.z << ", relative error "
                  << d.relative_error);
        CHECK(d.z < 4.5);
        CHECK(d.relative_error < least);
    }
}

Film render_with(const Scene& scene, MisHeuristic mis, SamplerKind sampler, std::uint32_t seed) {
    RenderSettings settings = statistical_settings(24, 18, Integrator::path, 4);
    settings.mis = mis;
    settings.sampler = sampler;
    settings.seed = seed;
    settings.sample_count = 128;
    return render_cpu(scene, settings, 128);
}

}  // namespace

TEST_CASE("The integrators agree on our own scenes") {
    for (const std::string& name : own_scenes()) {
        check_integrators(name, load_own_scene(name), BrdfModel::ggx, 64, 0.1);
    }
}

TEST_CASE("The integrators agree on our own scenes under Blinn-Phong") {
    for (const std::string name : {"brdf-grid", "veach-mis", "normal-map"}) {
        check_integrators(name, load_own_scene(name), BrdfModel::blinn_phong, 64, 0.1);
    }
}

TEST_CASE("The integrators agree on awkward lights and materials") {
    for (const auto& [name, scene] : agreement_scenes()) {
        check_integrators(name, scene, BrdfModel::ggx, 96, 0.025);
    }
}

TEST_CASE("The integrators agree by many samples", "[nightly]") {
    for (const std::string& name : own_scenes()) {
        check_integrators(name, load_own_scene(name), BrdfModel::ggx, 1024, 0.06);
    }
    for (const auto& [name, scene] : agreement_scenes()) {
        for (const BrdfModel brdf : brdf_models) {
            check_integrators(name, scene, brdf, 1024, 0.06);
        }
    }
}

TEST_CASE("Power and balance heuristic have one mean") {
    std::vector<std::pair<std::string, Scene>> scenes = agreement_scenes();
    scenes.emplace_back("veach-mis", load_own_scene("veach-mis"));
    for (const auto& [name, scene] : scenes) {
        const PairedDifference d =
            paired_difference(render_with(scene, MisHeuristic::power, SamplerKind::independent, 3),
                              render_with(scene, MisHeuristic::balance, SamplerKind::independent, 3));
        INFO(name << ": z " << d.z << ", relative error " << d.relative_error);
        CHECK(d.z < 4.5);
        CHECK(d.relative_error < 0.01);
    }
}

TEST_CASE("All samplers have one mean") {
    for (const std::string name : {"cornell", "brdf-grid", "courtyard"}) {
        const Scene scene = load_own_scene(name);
        const Film independent = render_with(scene, MisHeuristic::power, SamplerKind::independent, 3);
        for (const SamplerKind kind : {SamplerKind::hammersley, SamplerKind::sobol}) {
            const Film film = render_with(scene, MisHeuristic::power, kind, 3);
            const PairedDifference d = paired_difference(film, independent);
            INFO(name << " " << name_of(kind) << ": z " << d.z << ", relative error " << d.relative_error);
            CHECK(film_totals(film).nonfinite == 0);
            CHECK(d.z < 4.5);
            CHECK(d.relative_error < 0.06);
        }
    }
}
