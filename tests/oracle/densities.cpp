// What mode mis weighs draws by: the densities that are claimed are those that draws have.
#include <cmath>

#include "catch.h"
#include "oracle_fixture.h"

namespace diptych::core::tests {

namespace {

using namespace oracle;

constexpr int rings = 10;
constexpr int sectors = 12;
constexpr std::size_t cells = std::size_t(2 * rings * sectors);

/// Cells of equal solid angle over the whole sphere.
std::size_t cell_of(const dvec3& d) {
    const int ring = glm::clamp(int((d.z + 1) * rings), 0, 2 * rings - 1);
    const int sector = glm::clamp(int((std::atan2(d.y, d.x) / (2 * pi) + 0.5) * sectors), 0, sectors - 1);
    return std::size_t(ring * sectors + sector);
}

/// Each cell's probability by the midpoint rule.
template <typename Density>
std::vector<double> integrate(Density density) {
    constexpr int fine = 40;
    std::vector<double> sums(cells);
    for (int i = 0; i < 2 * rings * fine; ++i) {
        for (int j = 0; j < sectors * fine; ++j) {
            const dvec3 d = from_angles((i + 0.5) / (rings * fine) - 1, 2 * pi * ((j + 0.5) / (sectors * fine) - 0.5));
            sums[cell_of(d)] += density(d) * 4 * pi / (2.0 * rings * sectors * fine * fine);
        }
    }
    return sums;
}

/// Chi-square of the counts, cells that expect fewer than five left out, within z_limit standard deviations of its
/// mean.
void check_counts(const std::vector<double>& counts, const std::vector<double>& probabilities, double draws) {
    double chi_square = 0;
    double used = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double expected = probabilities[i] * draws;
        CHECK(counts[i] <= expected + 10 * std::sqrt(expected) + 5);
        if (expected >= 5) {
            chi_square += (counts[i] - expected) * (counts[i] - expected) / expected;
            ++used;
        }
    }
    INFO("chi-square " << chi_square << " over " << used << " cells");
    CHECK(used > 3);
    CHECK(chi_square < used + z_limit * std::sqrt(2 * used));
}

Bsdf bsdf_of(Distribution model, double alpha, double diffuse, double f0) {
    Bsdf bsdf;
    bsdf.model = model;
    bsdf.alpha = alpha;
    bsdf.diffuse = dvec3(diffuse);
    bsdf.f0 = dvec3(f0);
    bsdf.f90 = f0 > 0 ? 1 : 0;
    return bsdf;
}

}  // namespace

TEST_CASE("materials are drawn with the density they state, mapped ones by both models", "[oracle]") {
    const dvec3 up(0, 0, 1);
    std::uint64_t stream = 0;
    for (const Distribution model : {Distribution::ggx, Distribution::blinn_phong}) {
        for (const Bsdf& bsdf : {bsdf_of(model, 0.3, 0.5, 0.04), bsdf_of(model, 0.6, 0, 0.8), bsdf_of(model, 1, 0.8, 0),
                                 bsdf_of(model, 0, 0.5, 0.3)}) {
            for (const double cosine : {0.95, 0.3}) {
                const dvec3 o = from_angles(cosine, 0.3);
                const auto check = [&](NormalMaps maps, const dvec3& mapped) {
                    const Normals normals = make_normals(maps, up, up, mapped, o);
                    INFO((model == Distribution::ggx ? "ggx" : "blinn-phong")
                         << " alpha " << bsdf.alpha << " diffuse " << bsdf.diffuse.x << " cos " << cosine << " map "
                         << mapped.z << (maps == NormalMaps::shading ? " shading" : " microfacet"));
                    Random random(5, ++stream, 0);
                    std::vector<double> counts(cells);
                    const int draws = 40000;
                    for (int k = 0; k < draws; ++k) {
                        const Scattered drawn = sample(normals, bsdf, o, false, random);
                        if (drawn.weight != dvec3(0) && !drawn.mirrored) {
                            ++counts[cell_of(drawn.i)];
                        }
                    }
                    const auto stated = [&](const dvec3& i) { return density(normals, bsdf, o, i); };
                    check_counts(counts, integrate(stated), draws);
                };
                check(NormalMaps::shading, up);
                for (const dvec3& mapped : {from_angles(0.8, 2), from_angles(0.5, 0.4), from_angles(0.2, 3.3)}) {
                    check(NormalMaps::shading, mapped);
                    check(NormalMaps::microfacet, mapped);
                }
            }
        }
    }
}

TEST_CASE("an emitter that is hit has the density it is drawn with", "[oracle]") {
    Scene scene;
    Material dim = make_emitter("dim", {1, 2, 3});
    dim.base_color = glm::vec4(1);
    Material unlit = lambertian({0.5F, 1, 0.25F});
    unlit.unlit = true;
    add_object(scene, "floor",
               {quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, add_material(scene, lambertian(vec3(1))))});
    add_object(scene, "dim", {quad({0, 0, 1}, {4, 0, 1}, {4, 1, 1}, {0, 2, 1}, add_material(scene, dim))});
    add_object(scene, "unlit", {quad({0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}, add_material(scene, unlit))},
               translation(3, 0, 0));
    add_object(scene, "bright",
               {quad({0, 0, 3}, {0.1F, 0, 3}, {0.1F, 0.1F, 3}, {0, 0.1F, 3},
                     add_material(scene, make_emitter("bright", {100, 200, 50})))});
    const World world = make_world(scene);
    for (const EmitterChoice choice : {EmitterChoice::area, EmitterChoice::power}) {
        const Emitters emitters(world, choice);
        REQUIRE_FALSE(emitters.empty());
        std::vector<double> probabilities;
        for (std::size_t i = 0; i < world.triangles.size(); ++i) {
            probabilities.push_back(emitters.density(i) * area(world.triangles[i]));
        }
        double sum = 0;
        for (const double p : probabilities) {
            sum += p;
        }
        CHECK(sum == Approx(1).epsilon(1e-12));
        CHECK(probabilities[0] == 0);
        CHECK(emitters.density(6) / emitters.density(2) == Approx(choice == EmitterChoice::area ? 1 : 350.0 / 6));
        CHECK(emitters.density(4) / emitters.density(2) == Approx(choice == EmitterChoice::area ? 1 : 1.75 / 6));
        Random random(6, 0, 0);
        std::vector<double> counts(world.triangles.size());
        dvec2 middle(0);
        const int draws = 100000;
        for (int k = 0; k < draws; ++k) {
            const Emitters::Point point = emitters.sample(random);
            REQUIRE(point.density == emitters.density(point.triangle));
            ++counts[point.triangle];
            middle += point.barycentrics / double(draws);
        }
        check_counts(counts, probabilities, draws);
        CHECK(std::abs(middle.x - 1.0 / 3) < 4.5 * std::sqrt(1.0 / 18 / draws));
        CHECK(std::abs(middle.y - 1.0 / 3) < 4.5 * std::sqrt(1.0 / 18 / draws));
    }
    scene.instances.resize(1);
    CHECK(Emitters(make_world(scene), EmitterChoice::power).empty());
}

TEST_CASE("the sky's directions are drawn with the density they state", "[oracle]") {
    Environment map;
    map.kind = EnvironmentKind::map;
    map.scale = {2, 1, 0.5F};
    map.width = 6;
    map.height = 4;
    map.texels.resize(24);
    for (std::size_t i = 0; i < 24; ++i) {
        map.texels[i] = vec3(float((i * 7) % 5), float(i % 3), i == 9 ? 40.0F : 0.0F);
    }
    map.rotation = 1.1F;
    const SkyMap sky(map);
    REQUIRE_FALSE(sky.empty());
    // The poles stand upright in map and cells alike, where the density grows as 1 / sine.
    const auto turned = [](const dvec3& d) { return dvec3(d.z, d.x, d.y); };  // y to z
    const std::vector<double> probabilities =
        integrate([&](const dvec3& d) { return sky.density(dvec3(d.y, d.z, d.x)); });
    double sum = 0;
    for (const double p : probabilities) {
        sum += p;
    }
    CHECK(sum == Approx(1).epsilon(1e-2));
    Random random(7, 0, 0);
    std::vector<double> counts(cells);
    const int draws = 40000;
    for (int k = 0; k < draws; ++k) {
        const SkyMap::Direction drawn = sky.sample(random);
        REQUIRE(drawn.density == sky.density(drawn.direction));
        REQUIRE(drawn.density > 0);
        ++counts[cell_of(turned(drawn.direction))];
    }
    check_counts(counts, probabilities, draws);
    for (int k = 0; k < 1000; ++k) {  // wherever light comes from, a draw may go
        const dvec3 d = from_angles(2 * random.uniform() - 1, 2 * pi * random.uniform());
        const dvec3 light = environment_radiance(map, d);
        CHECK((sky.density(d) > 0) == (light.x + light.y + light.z > 0));
    }
    map.texels.assign(24, vec3(0));
    CHECK(SkyMap(map).empty());
    CHECK(SkyMap(constant_sky(vec3(1))).empty());
}

}  // namespace diptych::core::tests
