#include "swatches.h"

#include <cstdio>

#include "oracle_means.h"

namespace diptych::core::tests {

TextureSlot add_texels(Scene& scene, const Texels& texels, Filter filter, Wrap wrap_u, Wrap wrap_v) {
    TextureImage image;
    image.width = 2;
    image.height = 2;
    for (const auto& texel : texels) {
        image.rgba.insert(image.rgba.end(), texel.begin(), texel.end());
    }
    scene.images.push_back(image);
    Texture texture;
    texture.image = static_cast<int>(scene.images.size()) - 1;
    texture.filter = filter;
    texture.wrap_u = wrap_u;
    texture.wrap_v = wrap_v;
    scene.textures.push_back(texture);
    TextureSlot slot;
    slot.texture = static_cast<int>(scene.textures.size()) - 1;
    return slot;
}

Scene swatch_sheet(Scene scene, const std::vector<Swatch>& swatches) {
    scene.name = "swatches";
    for (std::size_t i = 0; i < swatches.size(); ++i) {
        const Swatch& swatch = swatches[i];
        Primitive plate;
        plate.material = add_material(scene, swatch.material);
        add_quad(plate, {-0.5F, -0.5F, 0}, {0.5F, -0.5F, 0}, {0.5F, 0.5F, 0}, {-0.5F, 0.5F, 0});
        plate.normals.assign(4, glm::normalize(glm::vec3(0, 0, 1) + swatch.lean));
        plate.tangents.assign(4, swatch.tangent);
        plate.colors = swatch.colors;
        for (const glm::vec4& uv : swatch.uvs) {
            plate.uvs[0].emplace_back(uv.x, uv.y);
            plate.uvs[1].emplace_back(uv.z, uv.w);
        }
        const auto column = static_cast<double>(i % oracle_columns);
        const auto row = static_cast<double>(i / oracle_columns);
        add_object(scene, swatch.name, {plate},
                   translation(column + 0.5, oracle_rows - row - 0.5, 0) * swatch.placement);
    }
    Camera camera;
    camera.orthographic = true;
    camera.orthographic_height = oracle_rows;
    camera.camera_to_world = translation(0.5 * oracle_columns, 0.5 * oracle_rows, 5);
    scene.cameras.push_back(camera);
    scene.environment.kind = EnvironmentKind::constant;
    scene.environment.scale = {0.15F, 0.14F, 0.12F};
    PunctualLight light;
    light.intensity = {14, 15, 12};
    light.light_to_world = translation(5, 4.5, 3);
    scene.lights.push_back(light);
    return scene;
}

void check_swatches(const Scene& sheet, const std::vector<Swatch>& swatches, BrdfModel brdf, double detectable) {
    RenderSettings settings = oracle_settings(1);
    settings.brdf = brdf;
    const OraclePair pair = render_with_oracle(sheet, settings, 1024);
    for (std::size_t i = 0; i < swatches.size(); ++i) {
        const auto column = static_cast<int>(i % oracle_columns);
        const auto row = static_cast<int>(i / oracle_columns);
        const ImageMean cpu = tile_mean(pair.cpu, column, row);
        const ImageMean oracle = tile_mean(pair.oracle, column, row);
        const double z = worst_z(cpu, oracle);
        const double found = detectable_bias(cpu, oracle, tile_limit);
        std::printf("%-12s %-40s z %.2f; would find a bias of %.2f %%\n", name_of(brdf), swatches[i].name.c_str(), z,
                    100 * found);
        INFO(name_of(brdf) << ", " << swatches[i].name << ": cpu " << describe(cpu) << "oracle " << describe(oracle));
        CHECK(z < tile_limit);
        CHECK(found < detectable);
    }
}

}  // namespace diptych::core::tests
