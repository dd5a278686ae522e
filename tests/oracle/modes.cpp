// The modes are four estimators of one picture.
#include <cmath>

#include "catch.h"
#include "oracle_fixture.h"

namespace diptych::core::tests {

namespace {

using namespace oracle;

/// Every thing that a mode may weigh wrongly: sky map, lamps of two sizes, one textured and covered by half, one unlit,
/// a mirror, a normal map, glossy walls.
Scene mixed_scene() {
    Scene scene;
    scene.environment.kind = EnvironmentKind::map;
    scene.environment.width = 4;
    scene.environment.height = 2;
    scene.environment.texels = {{1, 0, 0}, {2, 1, 0}, {6, 5, 4},    {0, 0, 1},
                                {0, 0, 0}, {0, 1, 0}, {0.5F, 0, 0}, {0, 0, 0}};
    scene.environment.scale = vec3(0.5F);
    scene.environment.rotation = 0.7F;
    scene.lights.push_back(point_light({0.5, 1.5, 0.5}, vec3(0.4F)));
    scene.images.push_back({"map", 2, 1, {200, 90, 200, 255, 100, 180, 220, 128}});
    scene.textures.push_back({"map", 0, Wrap::repeat, Wrap::repeat, Filter::linear});

    Material rough = glossy({0.7F, 0.6F, 0.5F}, 0.3F, 0.6F);
    rough.normal_texture.texture = 0;
    Primitive floor = quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, add_material(scene, rough));
    floor.uvs[0] = {{0, 0}, {3, 0}, {3, 3}, {0, 3}};
    floor.normals.assign(4, vec3(0, 1, 0));
    floor.tangents.assign(4, glm::vec4(1, 0, 0, 1));
    add_object(scene, "floor", {floor});
    add_object(scene, "wall",
               {quad({-2, 0, -2}, {2, 0, -2}, {2, 2, -2}, {-2, 2, -2},
                     add_material(scene, glossy({0.5F, 0.7F, 0.9F}, 1, 0.7F)))});
    add_object(scene, "mirror",
               {quad({-2, 0, 2}, {-2, 0, -2}, {-2, 1, -2}, {-2, 1, 2}, add_material(scene, glossy(vec3(0.8F), 0, 0)))});
    Material covered = make_emitter("covered", {4, 3, 2});
    covered.emission_texture.texture = 0;
    covered.base_color_texture.texture = 0;
    covered.base_color = glm::vec4(1);
    covered.alpha_mode = AlphaMode::blend;
    covered.double_sided = true;
    Primitive sheet =
        quad({-1, 1, -1}, {0.5F, 1, -1}, {0.5F, 1.3F, 0.5F}, {-1, 1.3F, 0.5F}, add_material(scene, covered));
    sheet.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    add_object(scene, "sheet", {sheet});
    Material sign = lambertian({2, 5, 3});
    sign.unlit = true;
    add_object(scene, "sign",
               {quad({1, 0.2F, -1}, {1.5F, 0.2F, -1}, {1.5F, 0.8F, -1}, {1, 0.8F, -1}, add_material(scene, sign))});
    scene.cameras.push_back(make_camera("camera", {1.6, 1.2, 2.5}, {-0.2, 0.4, -0.4}, 55));
    return scene;
}

}  // namespace

TEST_CASE("mis finds at each bounce what the other modes find", "[oracle]") {
    const Scene scene = mixed_scene();
    OracleSettings settings = small_settings(8, 8, 3);
    for (const auto& [model, maps] : {std::pair(Distribution::ggx, NormalMaps::shading),
                                      std::pair(Distribution::blinn_phong, NormalMaps::shading),
                                      std::pair(Distribution::ggx, NormalMaps::microfacet)}) {
        settings.distribution = model;
        settings.normal_maps = maps;
        settings.mode = Mode::mis;
        const Rendered mis = render(scene, settings, 3000);
        for (const Mode mode : {Mode::bsdf, Mode::hemisphere, Mode::area}) {
            settings.mode = mode;
            settings.seed += 1;
            const Rendered other = render(scene, settings, mode == Mode::hemisphere ? 20000 : 6000);
            for (unsigned k = 0; k <= 3; ++k) {
                INFO((model == Distribution::ggx ? "ggx, " : "blinn-phong, ")
                     << (maps == NormalMaps::shading ? "shading, " : "microfacet, ") << name_of(mode) << ", depth "
                     << k);
                check_equal(mis.depth(k), other.depth(k), k == 0 ? 0.02 : mode == Mode::hemisphere ? 0.08 : 0.06);
            }
        }
    }
}

TEST_CASE("without lamps and map mis is bsdf, draw by draw", "[oracle]") {
    Scene scene = mixed_scene();
    scene.environment = constant_sky({1, 2, 3});
    for (Material& material : scene.materials) {
        material.emission = vec3(0);
        material.unlit = false;
    }
    OracleSettings settings = small_settings(4, 4, 4);
    settings.mode = Mode::mis;
    const dvec3 mis = render(scene, settings, 50).all().mean;
    settings.mode = Mode::bsdf;
    CHECK(render(scene, settings, 50).all().mean == mis);
}

TEST_CASE("a near mirror shows of a lamp what a quadrature over the lamp gives", "[oracle]") {
    // A lamp of a size that area sampling can still bear, about the mirrored direction; and one ten times narrower than
    // the lobe.
    for (const float side : {0.06F, 0.002F}) {
        for (const Distribution model : {Distribution::ggx, Distribution::blinn_phong}) {
            Scene scene;
            const Material plate = glossy({0.9F, 0.6F, 0.3F}, 1, 0.1F);
            add_object(scene, "plate",
                       {quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, add_material(scene, plate))});
            const int light = add_material(scene, make_emitter("light", {3, 2, 1}));
            // In the plane x = -1, its front toward +x.
            const float y = 0.01F;
            const float z = 0.79F;
            add_object(scene, "light",
                       {quad({-1, y, z}, {-1, y + side, z}, {-1, y + side, z + side}, {-1, y, z + side}, light)});
            const dvec3 o = normalize(dvec3(1, 0, 0.8));
            scene.cameras.push_back(narrow_camera(o, dvec3(0)));
            Bsdf bsdf;
            bsdf.model = model;
            bsdf.alpha = double(0.1F) * double(0.1F);
            bsdf.f0 = dvec3(plate.base_color);
            bsdf.f90 = 1;
            const int n = 1500;
            dvec3 truth(0);
            for (int i = 0; i < n; ++i) {
                for (int j = 0; j < n; ++j) {
                    const dvec3 p(-1, double(y) + double(side) * (i + 0.5) / n,
                                  double(z) + double(side) * (j + 0.5) / n);
                    const double distance = length(p);
                    truth += evaluate(bsdf, {0, 0, 1}, o, p / distance) / (distance * distance * distance);
                }
            }
            truth *= dvec3(3, 2, 1) * double(side) * double(side) / double(n) / double(n);
            for (const Mode mode : {Mode::mis, Mode::bsdf, Mode::area}) {
                if (mode == Mode::bsdf && side < 0.01F) {
                    continue;  // it seldom meets so small a lamp
                }
                INFO("side " << side << (model == Distribution::ggx ? ", ggx, " : ", blinn-phong, ") << name_of(mode));
                OracleSettings settings = small_settings(8, 8, 1);
                settings.mode = mode;
                settings.distribution = model;
                check_mean(render(scene, settings, mode == Mode::mis ? 2000 : 8000).depth(1), truth, 0.01, 1e-4);
            }
        }
    }
}

}  // namespace diptych::core::tests
