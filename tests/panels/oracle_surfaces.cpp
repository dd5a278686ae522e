// What materials and their textures say, under transforms of every kind: the CPU panel against the oracle.
#include <cmath>

#include "swatches.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// Every channel has a mean of its own, and no two texels are alike.
const Texels all_differ = {{{230, 130, 60, 180}, {190, 150, 30, 140}, {210, 90, 70, 200}, {170, 110, 40, 120}}};

/// Normals that lean most along +y of the tangent frame, and a little along +x.
const Texels leaning = {{{150, 190, 220, 255}, {140, 200, 215, 255}, {120, 180, 225, 255}, {160, 170, 222, 255}}};

glm::dmat4 scaled(double x, double y, double z) {
    glm::dmat4 m(1);
    m[0][0] = x;
    m[1][1] = y;
    m[2][2] = z;
    return m;
}

glm::dmat4 turned(double degrees) {
    const double c = std::cos(glm::radians(degrees));
    const double s = std::sin(glm::radians(degrees));
    glm::dmat4 m(1);
    m[0] = {c, s, 0, 0};
    m[1] = {-s, c, 0, 0};
    return m;
}

glm::dmat4 sheared(double by) {
    glm::dmat4 m(1);
    m[1][0] = by;
    return m;
}

std::vector<Swatch> mapped_swatches(const TextureSlot& map) {
    const auto mapped = [&](const std::string& name, float scale, const glm::dmat4& placement = glm::dmat4(1)) {
        Swatch s;
        s.name = name;
        s.material = make_material(name, {0.8F, 0.6F, 0.4F}, 0.5F, 0.5F);
        s.material.normal_texture = map;
        s.material.normal_scale = scale;
        s.placement = placement;
        return s;
    };
    std::vector<Swatch> all = {
        mapped("plain", 1),
        mapped("scale 2", 2),
        mapped("scale 1/2", 0.5F),
        mapped("mirrored in x", 1, scaled(-1, 1, 1)),
        mapped("mirrored in x, scale 2", 2, scaled(-1, 1, 1)),
        mapped("mirrored in y, scale 1/2", 0.5F, scaled(1, -1, 1)),
        mapped("mirrored and turned", 1, turned(90) * scaled(-1, 1, 1)),
        mapped("mirrored and sheared, scale 2", 2, sheared(0.4) * scaled(-0.8, 0.7, 1.5)),
        mapped("mirrored in z: from behind", 1, scaled(1, 1, -1)),
        mapped("mirrored, tangent of sign -1", 1, scaled(-1, 1, 1)),
        mapped("mirrored, slanted tangent, scale 2", 2, scaled(-0.7, 1, 1)),
        mapped("mirrored, leaning vertex normals", 1, scaled(1, -0.6, 0.5)),
    };
    all[9].tangent.w = -1;
    all[10].tangent = {0.6F, 0.8F, 0, -1};
    all[11].lean = {0.3F, -0.2F, 0};
    return all;
}

/// One slot a swatch, then all at once.
std::vector<Swatch> textured_swatches(Scene& scene) {
    const TextureSlot texels = add_texels(scene, all_differ);
    const auto swatch = [](const std::string& name, const Material& material) {
        Swatch s;
        s.name = name;
        s.material = material;
        return s;
    };
    const Material white = make_material("white", {0.9F, 0.8F, 0.7F}, 0, 0.6F);
    Material glossy = make_material("glossy", glm::vec3(0.02F), 0, 0.5F);
    glossy.ior = 2;

    std::vector<Swatch> all;
    all.push_back(swatch("base colour", white));
    all.back().material.base_color_texture = texels;
    all.push_back(swatch("alpha under BLEND", all[0].material));
    all.back().material.alpha_mode = AlphaMode::blend;
    all.push_back(swatch("alpha under MASK", all[0].material));
    all.back().material.alpha_mode = AlphaMode::mask;
    all.back().material.alpha_cutoff = 0.6F;
    all.push_back(swatch("metallic and roughness", make_material("metal", {0.9F, 0.6F, 0.3F}, 0.9F, 0.8F)));
    all.back().material.metallic_roughness_texture = texels;
    all.push_back(swatch("specular factor", glossy));
    all.back().material.specular_texture = texels;
    all.push_back(swatch("specular colour", glossy));
    all.back().material.specular_color_texture = texels;
    all.push_back(swatch("emission", white));
    all.back().material.emission = {0.5F, 0.7F, 0.9F};
    all.back().material.emission_texture = texels;
    all.push_back(swatch("vertex colours", all[1].material));
    all.back().colors = {
        {0.9F, 0.5F, 0.2F, 0.8F}, {0.7F, 0.4F, 0.1F, 1}, {1, 0.6F, 0.3F, 0.6F}, {0.8F, 0.3F, 0.2F, 0.9F}};

    all.push_back(swatch("second set of coordinates", all[0].material));
    all.back().material.base_color_texture.uv_set = 1;
    all.back().uvs = {
        {{0.6F, 0.6F, 0.1F, 0.4F}, {0.9F, 0.6F, 0.4F, 0.4F}, {0.9F, 0.9F, 0.4F, 0.1F}, {0.6F, 0.9F, 0.1F, 0.1F}}};
    all.push_back(swatch("texture transform", all[0].material));
    all.back().material.base_color_texture.u_row = {0.3F, 0.2F, 0.05F};
    all.back().material.base_color_texture.v_row = {-0.2F, 0.3F, 0.6F};
    all.push_back(swatch("wrapping and filtering", white));
    all.back().material.base_color_texture = add_texels(scene, all_differ, Filter::linear, Wrap::mirror, Wrap::clamp);
    all.back().uvs = {{{-0.7F, 1.4F, 0, 0}, {0.6F, 1.4F, 0, 0}, {0.6F, 0.3F, 0, 0}, {-0.7F, 0.3F, 0, 0}}};

    all.push_back(swatch("all slots", make_material("all", {0.9F, 0.8F, 0.7F}, 0.9F, 0.8F)));
    Material& every = all.back().material;
    every.base_color_texture = add_texels(scene, all_differ);
    every.metallic_roughness_texture = add_texels(scene, all_differ, Filter::linear);
    every.specular_texture = add_texels(scene, all_differ, Filter::linear, Wrap::clamp);
    every.specular_color_texture = add_texels(scene, all_differ, Filter::nearest, Wrap::mirror);
    every.emission = {0.1F, 0.05F, 0.02F};
    every.emission_texture = texels;
    every.emission_texture.uv_set = 1;
    every.normal_texture = add_texels(scene, leaning);
    return all;
}

}  // namespace

TEST_CASE("Normal maps on mirrored and scaled instances have the oracle's means") {
    Scene scene;
    const std::vector<Swatch> swatches = mapped_swatches(add_texels(scene, leaning));
    const Scene sheet = swatch_sheet(scene, swatches);
    for (const BrdfModel brdf : brdf_models) {
        check_swatches(sheet, swatches, brdf, 0.04);
    }
}

TEST_CASE("Textures whose channels all differ have the oracle's means") {
    Scene scene;
    const std::vector<Swatch> swatches = textured_swatches(scene);
    check_swatches(swatch_sheet(scene, swatches), swatches, BrdfModel::ggx, 0.04);
}
