// Attributes between vertices: constants stay constants, the tangent's sign is interpolated, and a tangent that gives no
// direction leaves the normal map out.
#include <array>
#include <cmath>

#include "render_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// A unit square in z = 0 that faces +z and an orthographic camera sees whole, under a white sky.
Scene square_scene(Material material) {
    Scene scene;
    Primitive square;
    square.material = add_material(scene, std::move(material));
    add_quad(square, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    square.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    square.normals.assign(4, glm::vec3(0, 0, 1));
    add_object(scene, "square", {square});
    Camera camera;
    camera.orthographic = true;
    camera.orthographic_height = 1;
    camera.camera_to_world[3] = glm::dvec4(0.5, 0.5, 2, 1);
    scene.cameras.push_back(camera);
    scene.environment.kind = EnvironmentKind::constant;
    return scene;
}

Primitive& square_of(Scene& scene) {
    return scene.meshes[0].primitives[0];
}

int add_texel(Scene& scene, const std::array<std::uint8_t, 4>& rgba) {
    TextureImage image;
    image.width = 1;
    image.height = 1;
    image.rgba.assign(rgba.begin(), rgba.end());
    scene.images.push_back(image);
    Texture texture;
    texture.image = static_cast<int>(scene.images.size()) - 1;
    scene.textures.push_back(texture);
    return static_cast<int>(scene.textures.size()) - 1;
}

/// Lambertian, under a map whose normal leans along the bitangent by 30 degrees, lit from 45 degrees along +y: as bright
/// as `along` where the tangent's sign is +1, as `against` where it is -1.
struct Leaning {
    Scene scene;
    double along;
    double against;
};

Leaning leaning_square() {
    Material white = make_material("white", glm::vec3(1), 0, 1);
    white.specular = 0;
    Scene scene = square_scene(white);
    scene.environment.kind = EnvironmentKind::none;
    scene.materials[0].normal_texture.texture = add_texel(scene, {128, 191, 238, 255});
    square_of(scene).tangents.assign(4, glm::vec4(1, 0, 0, 1));
    PunctualLight sun;
    sun.type = PunctualType::directional;
    sun.intensity = glm::vec3(static_cast<float>(M_PI));
    const double c = std::sqrt(0.5);
    sun.light_to_world = glm::dmat4(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, c, -c, 0), glm::dvec4(0, c, c, 0), glm::dvec4(0, 0, 5, 1));
    scene.lights.push_back(sun);
    const glm::dvec3 n = glm::normalize(glm::dvec3(1, 127, 221) / 255.0);  // 2 texel - 1
    return {scene, c * (n.z + n.y), c * (n.z - n.y)};
}

double mean_of(const Scene& scene) {
    return image_mean(render_cpu(scene, statistical_settings(64, 64, Integrator::path, 1), 16)).mean[0];
}

}  // namespace

TEST_CASE("An alpha equal to its cutoff leaves no holes") {
    for (const bool textured : {false, true}) {
        Material leaf = make_material("leaf", glm::vec3(1), 0, 1);
        leaf.unlit = true;
        leaf.alpha_mode = AlphaMode::mask;
        leaf.alpha_cutoff = textured ? 0.4F * (128.0F / 255.0F) : 0.4F;
        leaf.base_color.a = 0.4F;
        Scene scene = square_scene(leaf);
        scene.environment.kind = EnvironmentKind::none;
        square_of(scene).colors.assign(4, glm::vec4(1));
        if (textured) {
            scene.materials[0].alpha_cutoff = 0.4F * (static_cast<float>(128) * (1.0F / 255.0F));
            scene.materials[0].base_color_texture.texture = add_texel(scene, {255, 255, 255, 128});
        }
        const Film film = render_cpu(scene, statistical_settings(64, 64, Integrator::path, 0), 16);
        std::size_t holes = 0;
        for (const auto& pixel : film.pixels) {
            holes += pixel_mean(pixel)[0] == 1.0 ? 0 : 1;
        }
        INFO("textured " << textured);
        CHECK(holes == 0);
    }
}

TEST_CASE("The tangent's sign is interpolated, whichever corner comes first") {
    Leaning leaning = leaning_square();
    CHECK(std::abs(mean_of(leaning.scene) - leaning.along) < 1e-4);
    // Of one triangle, half of the square, a quarter lies beyond weight 1/2 of the corner where the sign is -1.
    Primitive& square = square_of(leaning.scene);
    const double expected = leaning.along * 7 / 8 + leaning.against / 8;
    for (const std::uint32_t corner : {1U, 3U}) {
        square.tangents.assign(4, glm::vec4(1, 0, 0, 1));
        square.tangents[corner].w = -1;
        for (int turn = 0; turn < 3; ++turn) {
            for (glm::uvec3& t : square.triangles) {
                t = {t.y, t.z, t.x};
            }
            INFO("corner " << corner << " turn " << turn);
            CHECK(std::abs(mean_of(leaning.scene) - expected) < 2e-3);
        }
    }
}

TEST_CASE("A tangent along the normal leaves the normal map out") {
    Leaning leaning = leaning_square();
    const double flat = std::sqrt(0.5);
    for (const glm::vec3& tangent : {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(0, 0, 0)}) {
        square_of(leaning.scene).tangents.assign(4, glm::vec4(tangent, 1));
        CHECK(std::abs(mean_of(leaning.scene) - flat) < 1e-4);
    }
    for (const float sine : {0.5e-4F, 2e-4F}) {  // to the normal; 1e-4 is the least that gives a direction
        square_of(leaning.scene).tangents.assign(4, glm::vec4(sine, 0, 1, 1));
        CAPTURE(sine);
        CHECK(std::abs(mean_of(leaning.scene) - (sine < 1e-4F ? flat : leaning.along)) < 1e-4);
    }
}

TEST_CASE("The layer of normals holds the map's normal by either model, as far as the surface is shaded by it") {
    for (const NormalMaps model : {NormalMaps::shading, NormalMaps::microfacet}) {
        for (const bool below : {false, true}) {
            Leaning leaning = leaning_square();
            if (below) {
                leaning.scene.images[0].rgba = {128, 255, 64, 255};
            }
            RenderSettings settings = statistical_settings(4, 4, Integrator::path, 1);
            settings.normal_maps = model;
            settings.first_hit_layers = true;
            const Film film = render_cpu(leaning.scene, settings, 4);
            glm::dvec3 expected = glm::normalize(below ? glm::dvec3(1, 255, -127) : glm::dvec3(1, 127, 221));
            if (below && model == NormalMaps::shading) {  // raised until its cosine to the surface is a hundredth
                const glm::dvec2 along = glm::normalize(glm::dvec2(expected)) * std::sqrt(1 - 1e-4);
                expected = glm::dvec3(along, 1e-2);
            }
            INFO((model == NormalMaps::shading ? "shading" : "microfacet") << (below ? ", below" : ""));
            for (std::size_t i = 0; i < film.pixels.size(); ++i) {
                const Rgb normal = mean_first_hit(film.pixels[i], film.first_hits[i]).normal;
                CHECK(glm::length(glm::dvec3(normal[0], normal[1], normal[2]) - expected) < 1e-5);
            }
        }
    }
}
