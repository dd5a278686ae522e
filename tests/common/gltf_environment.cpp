// Environment maps from files.
#include <OpenImageIO/imageio.h>
#include <memory>

#include "catch.h"
#include "error.h"
#include "gltf_fixture.h"
#include "scene/environment_load.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

std::filesystem::path write_exr(const TemporaryFolder& folder, int width, int height, const std::vector<float>& rgb) {
    const std::filesystem::path file = folder.path() / "map.exr";
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(file.string());
    REQUIRE(output);
    REQUIRE(output->open(file.string(), OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::FLOAT)));
    REQUIRE(output->write_image(OIIO::TypeDesc::FLOAT, rgb.data()));
    output->close();
    return file;
}

std::filesystem::path write_png(const TemporaryFolder& folder) {
    const std::filesystem::path file = folder.path() / "map.png";
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(file.string());
    REQUIRE(output);
    REQUIRE(output->open(file.string(), OIIO::ImageSpec(2, 1, 3, OIIO::TypeDesc::UINT8)));
    const std::vector<std::uint8_t> grey(6, 128);
    REQUIRE(output->write_image(OIIO::TypeDesc::UINT8, grey.data()));
    output->close();
    return file;
}

}  // namespace

TEST_CASE("an environment map keeps its radiance, top row first", "[environment]") {
    const TemporaryFolder folder;
    std::string warnings;
    const Environment map = load_environment(write_exr(folder, 2, 1, {1, 2, 3, 1000, 0, 0.5F}), &warnings);
    CHECK(map.kind == Environment::Kind::map);
    CHECK(map.width == 2);
    CHECK(map.height == 1);
    REQUIRE(map.texels.size() == 2);
    CHECK(map.texels[0] == glm::vec3(1, 2, 3));
    CHECK(map.texels[1] == glm::vec3(1000, 0, 0.5F));
    CHECK(warnings.empty());
}

TEST_CASE("odd texels and shapes of an environment map are warned of", "[environment]") {
    const TemporaryFolder folder;
    std::string warnings;
    const Environment map =
        load_environment(write_exr(folder, 2, 2, {1, -2, -1, 1, 1, 1, -1, 1, 1, 1, 1, 1}), &warnings);
    CHECK(map.texels.at(0) == glm::vec3(1, 0, 0));
    CHECK(map.texels.at(2) == glm::vec3(0, 1, 1));
    CHECK_THAT(warnings, Catch::Contains("2 texels") && Catch::Contains("2x2 is not twice as wide as high"));
}

TEST_CASE("environment maps that cannot be read are refused", "[environment]") {
    const TemporaryFolder folder;
    CHECK_THROWS_WITH(load_environment(folder.path() / "none.hdr"),
                      Catch::Contains("none.hdr") && Catch::Contains("no such file"));
    CHECK_THROWS_WITH(load_environment(folder.path()), Catch::Contains("is a folder"));
    CHECK_THROWS_WITH(load_environment(write_png(folder)),
                      Catch::Contains("map.png") && Catch::Contains("not radiance"));
    CHECK_THROWS_AS(load_environment(folder.write("empty.exr", "")), Error);
    CHECK_THROWS_AS(load_environment(folder.write("text.hdr", "no radiance here")), Error);
    CHECK_THROWS_AS(load_environment(folder.write("map.unknown", "no radiance here")), Error);
}

TEST_CASE("the neutral sky has luminance 1", "[environment]") {
    const glm::vec3 sky = neutral_sky().scale;
    CHECK(neutral_sky().kind == Environment::Kind::constant);
    CHECK(glm::dot(sky, glm::vec3(0.2126F, 0.7152F, 0.0722F)) == Approx(1));
    CHECK(sky.b > sky.r);
}

TEST_CASE("the environment maps of the assets load", "[environment]") {
    const std::filesystem::path folder = asset_folder() / "hdr";
    if (!std::filesystem::exists(folder)) {
        SKIP_TEST("no assets at " + asset_folder().string());
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        INFO(entry.path().string());
        const Environment map = load_environment(entry.path());
        glm::dvec3 sum(0);
        for (const glm::vec3& texel : map.texels) {
            sum += glm::dvec3(texel);
        }
        CHECK(sum.x > 0);
        CHECK(std::isfinite(sum.x + sum.y + sum.z));
    }
}
