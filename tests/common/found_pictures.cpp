// Pictures of other programs that lie beside the repository, each with the picture that it must equal or the refusal.
#include <filesystem>

#include "catch.h"
#include "error.h"
#include "gltf_fixture.h"
#include "image/layered_image.h"
#include "scene/environment_load.h"

using namespace diptych::core;

namespace {

std::filesystem::path found() {
    return tests::asset_folder() / "found";
}

std::vector<glm::vec3> sky(const std::string& name) {
    return load_environment((found() / name).string()).texels;
}

std::string refusal_of_sky(const std::string& name) {
    try {
        sky(name);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("found pictures are read as their headers say", "[image][environment]") {
    if (!std::filesystem::exists(found() / "images")) {
        SKIP_TEST("no pictures at " + found().string());
    }
    CHECK(sky("images/e_up.hdr") == sky("images/e_flat.hdr"));
    CHECK(sky("images/e_tr.hdr") == sky("images/e_flat.hdr"));
    CHECK(sky("images/e_exp.hdr") == sky("images/e_flat.hdr"));
    CHECK(sky("images/e_crop.exr") == sky("images/e_cropref.exr"));
    CHECK(sky("images/e_multi.exr") == sky("images/e_multi.exr:beauty"));
    CHECK(sky("images/e_bl.exr:ViewLayer.Combined") != sky("images/e_bl.exr:ViewLayer.AO"));
    CHECK(sky("images/e_layers.exr:beauty") != sky("images/e_layers.exr:albedo"));
    CHECK(sky("images/e_xyze.hdr") != sky("images/e_flat.hdr"));
    const PixelWindow a = read_image(found() / "images/k_crop.exr").data, b = read_image(found() / "images/k_crop2.exr").data;
    CHECK(intersection(a, b) == PixelWindow{10, 10, 30, 14});
}

TEST_CASE("found files that are not pictures are refused by what they are", "[image][environment]") {
    if (!std::filesystem::exists(found() / "broken")) {
        SKIP_TEST("no pictures at " + found().string());
    }
    CHECK_THAT(refusal_of_sky("images/e_layers.exr"), Catch::Contains("FILE:LAYER (albedo, beauty)"));
    CHECK_THAT(refusal_of_sky("images/e_bl.exr"), Catch::Contains("(ViewLayer.AO, ViewLayer.Combined)"));
    CHECK_THAT(refusal_of_sky("images/e_xyz.exr"), Catch::Contains("no chromaticities say"));
    CHECK_THAT(refusal_of_sky("images/e_rg.exr"), Catch::Contains("it holds R, G"));
    CHECK_THAT(refusal_of_sky("broken/c2.exr"), Catch::Contains("it holds R, G"));
    CHECK_THAT(refusal_of_sky("broken/dep.exr"), Catch::Contains("it holds depth, nx, ny"));
    CHECK_THAT(refusal_of_sky("broken/deep.exr"), Catch::Contains("deep data"));
    CHECK_THAT(refusal_of_sky("broken/hdr-16000.hdr"), Catch::Contains("at least 128000 bytes"));
}
