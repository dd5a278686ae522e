// Attributes between vertices and texels: constants stay constants; tangents, their sign, and where they fail.
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "catch.h"
#include "oracle/random.h"
#include "oracle/texture.h"
#include "oracle_fixture.h"
#include "gltf/import.h"

namespace diptych::core::tests {

namespace {

using namespace oracle;

/// A unit square in z = 0, front toward +z, that an orthographic camera sees whole.
Scene square_scene(const Material& material) {
    Scene scene;
    Primitive square = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, add_material(scene, material));
    square.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    square.normals.assign(4, vec3(0, 0, 1));
    add_object(scene, "square", {square});
    Camera camera;
    camera.orthographic = true;
    camera.orthographic_height = 1;
    camera.camera_to_world[3] = glm::dvec4(0.5, 0.5, 2, 1);
    scene.cameras.push_back(camera);
    return scene;
}

Primitive& square_of(Scene& scene) {
    return scene.meshes[0].primitives[0];
}

int add_texture(Scene& scene, int size, const std::vector<std::uint8_t>& rgba) {
    scene.images.push_back({"image", size, size, rgba});
    scene.textures.push_back({"texture", int(scene.images.size()) - 1, Wrap::repeat, Wrap::repeat, Filter::linear});
    return int(scene.textures.size()) - 1;
}

/// The square with a map whose normal leans by `y`, of 127, along the bitangent.
Scene mapped_square(std::uint8_t x, std::uint8_t y) {
    Scene scene = square_scene(lambertian(vec3(1)));
    scene.materials[0].normal_texture.texture = add_texture(scene, 1, {x, y, 230, 255});
    square_of(scene).tangents.assign(4, glm::vec4(1, 0, 0, 1));
    return scene;
}

dvec3 normal_at(const Scene& scene, dvec2 barycentrics, const dvec3& o, NormalMaps maps = NormalMaps::shading) {
    const World world = make_world(scene);
    return shown_normal(make_surface(world, Distribution::ggx, maps, {0, barycentrics, 1}, o).normals);
}

/// Mean of the picture's normals.
dvec3 mean_normal(const Scene& scene, int side, std::uint64_t spp) {
    const Rendered picture = render(scene, small_settings(side, side, 1), spp);
    dvec3 sum(0);
    for (const OraclePixel& pixel : picture.image.pixels) {
        sum += pixel.mean_normal();
    }
    return sum / double(picture.image.pixels.size());
}

/// The share of the picture's rays that met something, of base colour 1.
double covered_share(const Scene& scene, int side, std::uint64_t spp) {
    const Rendered picture = render(scene, small_settings(side, side, 0), spp);
    double sum = 0;
    for (const OraclePixel& pixel : picture.image.pixels) {
        sum += pixel.mean_depth() > 0 ? pixel.mean_albedo().x : 0;
    }
    return sum / double(picture.image.pixels.size());
}

std::filesystem::path found_file(const char* name) {
    const char* const given = std::getenv("DIPTYCH_ASSETS");
    const std::filesystem::path folder = given != nullptr
                                             ? std::filesystem::path(given)
                                             : std::filesystem::path(DIPTYCH_SOURCE_DIR) / "../shared/assets";
    return folder / "found/materials" / name;
}

}  // namespace

TEST_CASE("an attribute that is equal at three corners or four texels is exactly that everywhere", "[oracle]") {
    Scene scene = square_scene(lambertian(vec3(1)));
    Random random(11, 0, 0);
    TextureSlot slot;
    slot.texture = add_texture(scene, 2, {77, 3, 201, 99, 77, 3, 201, 99, 77, 3, 201, 99, 77, 3, 201, 99});
    const World world = make_world(scene);
    for (int k = 0; k < 1000; ++k) {
        const double s = std::sqrt(random.uniform());
        const dvec2 uv(1 - s, s * random.uniform());
        const glm::vec4 value(float(random.uniform()), 0.1F, 1e-20F, 3e8F);
        CHECK(interpolate(std::vector<glm::vec4>(4, value), world.triangles[k % 2], uv) == glm::dvec4(value));
        CHECK(sample_texture(scene, slot, world.triangles[k % 2], uv, Encoding::linear) ==
              glm::dvec4(77, 3, 201, 99) / 255.0);
    }
}

TEST_CASE("a surface whose alpha equals its cutoff has no holes", "[oracle]") {
    for (const float cutoff : {0.5F, 0.1F, 128 / 255.0F, 0.7F}) {
        INFO("cutoff " << cutoff);
        Material material = lambertian(vec3(1));
        material.alpha_mode = AlphaMode::mask;
        material.alpha_cutoff = cutoff;
        Scene by_vertex = square_scene(material);
        square_of(by_vertex).colors.assign(4, glm::vec4(1, 1, 1, cutoff));
        CHECK(covered_share(by_vertex, 16, 16) == 1);
        material.base_color.a = cutoff;
        Scene by_factor = square_scene(material);
        square_of(by_factor).colors.assign(4, glm::vec4(1));
        const int white = add_texture(by_factor, 2, std::vector<std::uint8_t>(16, 255));
        by_factor.materials[0].base_color_texture.texture = white;
        CHECK(covered_share(by_factor, 16, 16) == 1);
        by_factor.materials[0].alpha_cutoff = std::nextafter(cutoff, 1.0F);
        CHECK(covered_share(by_factor, 16, 16) == 0);
    }
    Material material = lambertian(vec3(1));
    material.alpha_mode = AlphaMode::mask;
    for (const int texel : {1, 100, 128, 254}) {
        Scene scene = square_scene(material);
        std::vector<std::uint8_t> rgba(16, 255);
        for (std::size_t k = 3; k < 16; k += 4) {
            rgba[k] = std::uint8_t(texel);
        }
        scene.materials[0].base_color_texture.texture = add_texture(scene, 2, rgba);
        scene.materials[0].alpha_cutoff = float(texel) / 255.0F;
        INFO("texel " << texel);
        CHECK(covered_share(scene, 16, 16) == 1);
    }
}

TEST_CASE("the tangent's sign is interpolated, whichever corner comes first", "[oracle]") {
    // The map's normal leans along the bitangent, which turns round where w falls below 0: beyond the middle of the
    // edges that leave the corner of w = -1, a quarter of each triangle that has it.
    const double leaning = normal_at(mapped_square(128, 160), {0.2, 0.2}, {0, 0, 1}).y;
    REQUIRE(leaning == Approx((2 * 160 / 255.0 - 1) / std::sqrt(std::pow(2 * 160 / 255.0 - 1, 2) +
                                                                 std::pow(2 * 230 / 255.0 - 1, 2) +
                                                                 std::pow(2 * 128 / 255.0 - 1, 2)))
                           .epsilon(1e-9));
    for (std::size_t corner = 0; corner < 4; ++corner) {
        for (int turned = 0; turned < 3; ++turned) {
            Scene scene = mapped_square(128, 160);
            Primitive& square = square_of(scene);
            square.tangents[corner].w = -1;
            double share = 0;
            for (glm::uvec3& t : square.triangles) {
                for (int k = 0; k < turned; ++k) {
                    t = {t.y, t.z, t.x};
                }
                share += t.x == corner || t.y == corner || t.z == corner ? 1.0 / 8 : 0;
            }
            INFO("corner " << corner << " turned " << turned);
            // 65536 samples, one a stratum: only those that the border crosses vary.
            CHECK(mean_normal(scene, 64, 16).y == Approx(leaning * (1 - 2 * share)).margin(2e-3 * leaning));
        }
    }
}

TEST_CASE("a map is not used where its tangent runs along the normal", "[oracle]") {
    const dvec3 up(0, 0, 1);
    const dvec3 mapped = normal_at(mapped_square(200, 128), {0.3, 0.3}, up);
    REQUIRE(mapped.x > 0.3);
    for (const float across : {0.0F, 0.9e-4F, 1.1e-4F, 1e-2F}) {
        Scene scene = mapped_square(200, 128);
        square_of(scene).tangents.assign(4, glm::vec4(across, 0, 1, 1));
        INFO("across " << across);
        CHECK(length(normal_at(scene, {0.3, 0.3}, up) - (across > 1e-4F ? mapped : up)) < 1e-9);
    }
    Scene opposed = mapped_square(200, 128);  // tangents that cancel half-way
    square_of(opposed).tangents[1] = glm::vec4(-1, 0, 0, 1);
    CHECK(normal_at(opposed, {0.5, 0}, up) == up);
    CHECK(length(normal_at(opposed, {0.4, 0}, up) - mapped) < 1e-9);
}

TEST_CASE("a map that is scaled to nothing leaves the surface's own scattering", "[oracle]") {
    Random random(12, 0, 0);
    for (int k = 0; k < 50; ++k) {  // normals, of which rounding would change most
        Scene scene = mapped_square(200, 90);
        scene.materials[0].normal_scale = 0;
        square_of(scene).normals.assign(4, normalize(vec3(float(random.uniform()), float(random.uniform()), 1)));
        const World world = make_world(scene);
        for (const dvec3& o : {dvec3(0, 0, 1), normalize(dvec3(-1, 0.6, 0.05))}) {
            const Surface surface = make_surface(world, Distribution::ggx, NormalMaps::shading, {0, {0.3, 0.3}, 1}, o);
            CHECK(std::holds_alternative<Facets>(surface.normals));
        }
    }
}

TEST_CASE("a picture of normals shows the mapped normal, held above the surface", "[oracle]") {
    Scene scene = mapped_square(255, 128);
    scene.materials[0].normal_scale = 400;  // which leans by more than 89.8 degrees
    for (const double x : {-0.99, -0.2, 0.6}) {
        const dvec3 o(x, 0, std::sqrt(1 - x * x));
        const dvec3 n = normal_at(scene, {0.3, 0.3}, o);
        CHECK(n.z == Approx(0.01).epsilon(1e-9));
        CHECK(length(n) == Approx(1).epsilon(1e-12));
    }
    const dvec3 below = normal_at(scene, {0.3, 0.3}, {0, 0, -1});  // from the back
    CHECK(below.z == Approx(-0.01).epsilon(1e-9));
    CHECK(mean_normal(scene, 4, 4).z == Approx(0.01).epsilon(0).margin(OraclePixel::fixed_unit / 2));

    // The bent normal of a surface without a map; a mapped one is not bent by the model `shading`.
    const dvec3 grazing = normalize(dvec3(1, 0, 0.1));
    Scene leaning = square_scene(lambertian(vec3(1)));
    square_of(leaning).normals.assign(4, normalize(vec3(-1, 0, 1)));
    CHECK(dot(normal_at(leaning, {0.3, 0.3}, grazing), grazing) == Approx(1e-3));
    Scene away = mapped_square(20, 128);
    CHECK(normal_at(away, {0.3, 0.3}, grazing) == normal_at(away, {0.3, 0.3}, {0, 0, 1}));
    CHECK(dot(normal_at(away, {0.3, 0.3}, grazing), grazing) < 0);
}

TEST_CASE("files on which normal maps and cutoffs were wrong give what their geometry says", "[oracle]") {
    if (!std::filesystem::exists(found_file("nm_tilt.glb"))) {
        SKIP_TEST("no files in " + found_file("").string());
    }
    const auto picture = [](const char* name, int side, std::uint64_t spp) {
        return render(load_gltf(found_file(name)), small_settings(side, side, 1), spp);
    };
    // Light of irradiance pi on a diffuse 0.8: n l.
    CHECK(picture("nm_tilt.glb", 4, 64).all().mean.x == Approx(0.794).epsilon(0.01));
    CHECK(picture("nm_away.glb", 4, 64).all().mean.x == Approx(0.314).epsilon(0.01));
    CHECK(covered_share(load_gltf(found_file("cut0.5-vec3.glb")), 32, 64) == Approx(0.8F));
    // w is below 0 on a quarter of the square, and the map's normal leans down elsewhere.
    const Scene turning = load_gltf(found_file("turn0.glb"));
    const dvec3 elsewhere = normal_at(turning, {0.6, 0.3}, {0, 0, 1});
    const dvec3 mean = mean_normal(turning, 64, 16);
    CHECK(elsewhere.y < -0.3);
    CHECK(mean.y / mean.z == Approx(0.5 * elsewhere.y / elsewhere.z).epsilon(0.01));
    const Rendered dome = picture("dome_d50_map.glb", 40, 64);
    const double right[] = {0.074, 0.235, 0.389, 0.520, 0.621, 0.712, 0.771};  // at x = -0.6 ... 0.6 of the geometry
    for (int k = 0; k < 7; ++k) {
        const OraclePixel& left = dome.image.pixels[std::size_t(20 * 40 + 8 + 4 * k - 1)];
        const OraclePixel& beside = dome.image.pixels[std::size_t(20 * 40 + 8 + 4 * k)];
        INFO("place " << k);
        CHECK(0.5 * (left.mean().x + beside.mean().x) == Approx(right[k]).margin(0.02));
    }
}

}  // namespace diptych::core::tests
