#include "catch.h"

#include <nlohmann/json.hpp>

#include "common/exr_bytes.h"
#include "image/atomic_file.h"
#include "image/layered_image.h"
#include "process.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

std::string render_picture(const TemporaryFolder& folder, const std::string& scene, const std::string& name,
                           std::vector<std::string> more) {
    more.insert(more.begin(), {"render", scene, "-o", folder.file(name), "--size", "32"});
    const ProcessResult result = run_diptych(folder, more);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return folder.file(name);
}

/// A copy of an EXR with its colour times `factor`, said to have another seed.
std::string scaled_copy(const TemporaryFolder& folder, const std::string& path, float factor) {
    LayeredImage image = read_image(path);
    for (float& value : image.color.data) {
        value *= factor;
    }
    image.metadata["seed"] = "1000";
    write_exr(folder.file("scaled.exr"), image);
    return folder.file("scaled.exr");
}

}  // namespace

TEST_CASE("pictures of independent seeds differ by noise, a brighter one by more", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string a = render_picture(folder, scene, "a.exr", {"--spp", "16", "--seed", "1"});
    const std::string b = render_picture(folder, scene, "b.exr", {"--spp", "16", "--seed", "2"});
    const std::string figure = folder.file("figure.png");
    const ProcessResult result = run_diptych(folder, {"compare", a, b, "-o", figure, "--json", "--max-z", "4"});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK(result.err.empty());
    const auto json = nlohmann::json::parse(result.out);
    CHECK(json.at("mse").get<double>() > 0);
    CHECK(json.at("relmse").get<double>() > 0);
    CHECK(json.at("mean_ratio").size() == 3);
    CHECK(json.at("z_mean").size() == 3);
    CHECK(json.at("noise") == true);
    CHECK(json.at("passed") == true);
    CHECK(contains(json.at("verdict"), "within the noise"));
    const LayeredImage panels = read_image(figure);
    CHECK(panels.color.height == 32);
    CHECK(panels.color.width == 3 * 32 + 2 * 4);

    const std::string brighter = scaled_copy(folder, a, 1.5F);
    const ProcessResult failed = run_diptych(folder, {"compare", brighter, b, "--json", "--max-z", "4"});
    CHECK(failed.exit_code == 1);
    const auto failed_json = nlohmann::json::parse(failed.out);
    CHECK(failed_json.at("noise") == false);
    CHECK(failed_json.at("passed") == false);
    CHECK(contains(failed_json.at("verdict"), "MORE than noise"));
    CHECK(failed_json.at("mean_ratio")[0].get<double>() == Approx(1.5).epsilon(0.05));
    CHECK(contains(failed.err, "exceeds 4"));
    CHECK(run_diptych(folder, {"compare", brighter, b}).exit_code == 0);  // no check was asked for
}

TEST_CASE("pictures of one seed are told apart from independent ones", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string a = render_picture(folder, scene, "a.exr", {"--spp", "4", "--max-depth", "2"});
    const std::string b = render_picture(folder, scene, "b.exr", {"--spp", "4", "--max-depth", "3"});
    const ProcessResult result = run_diptych(folder, {"compare", a, b});
    CHECK(result.exit_code == 0);
    CHECK(contains(result.err, "ignore z"));
    CHECK(contains(result.out, "same random numbers"));
    LayeredImage rounded = read_image(a);
    rounded.color.data[100] *= 1.000001F;
    write_exr(folder.file("rounded.exr"), rounded);
    const ProcessResult close = run_diptych(folder, {"compare", a, folder.file("rounded.exr")});
    CHECK(contains(close.out, "the remaining difference is rounding"));
    const ProcessResult same = run_diptych(folder, {"compare", a, a});
    CHECK(contains(same.out, "identical"));
}

TEST_CASE("relMSE can be a check", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string a = render_picture(folder, scene, "a.exr", {"--spp", "4", "--seed", "1"});
    const std::string b = render_picture(folder, scene, "b.exr", {"--spp", "4", "--seed", "2"});
    CHECK(run_diptych(folder, {"compare", a, b, "--max-relmse", "10"}).exit_code == 0);
    const ProcessResult failed = run_diptych(folder, {"compare", a, b, "--max-relmse", "1e-9"});
    CHECK(failed.exit_code == 1);
    CHECK(contains(failed.err, "relMSE"));
}

TEST_CASE("compare refuses what cannot be compared", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string a = render_picture(folder, scene, "a.exr", {"--spp", "1"});
    const std::string bare = render_picture(folder, scene, "bare.exr", {"--spp", "1", "--no-layers", "--seed", "3"});
    const std::string small = render_picture(folder, scene, "small.png", {"--spp", "1"});
    check_refusal(run_diptych(folder, {"compare", a, folder.file("none.exr")}), 2, {"none.exr"});
    check_refusal(run_diptych(folder, {"compare", a, a, "-o", folder.file("no/f.png")}), 2, {"no/f.png"});
    check_refusal(run_diptych(folder, {"compare", a, a, "-o", folder.file("f.exr")}), 2, {"f.exr", ".png"});
    check_refusal(run_diptych(folder, {"compare", a, bare, "--max-z", "4"}), 2, {"bare.exr", "standard errors"});
    CHECK(contains(run_diptych(folder, {"compare", a, bare}).out, "no test can tell"));
    LayeredImage wide;
    wide.color = make_image(33, 32, 3, 1);
    write_exr(folder.file("wide.exr"), wide);
    check_refusal(run_diptych(folder, {"compare", a, folder.file("wide.exr")}), 2, {"wide.exr", "33x32", "32x32"});
}

TEST_CASE("compare --minus takes a part off both pictures first", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const auto render = [&](const std::string& name, const std::string& depth, const std::string& seed) {
        REQUIRE(run_diptych(folder, {"render", scene, "-o", folder.file(name), "--size", "16", "--spp", "2",
                                     "--max-depth", depth, "--seed", seed})
                    .exit_code == 0);
    };
    render("a0.exr", "0", "1");
    render("b0.exr", "0", "2");
    render("a1.exr", "1", "1");
    // Lamp less lamp is nothing, whatever their noise.
    const ProcessResult same = run_diptych(folder, {"compare", folder.file("a0.exr"), folder.file("b0.exr"), "--minus",
                                                    folder.file("a0.exr") + "," + folder.file("b0.exr"), "--json"});
    INFO(same.err);
    REQUIRE(same.exit_code == 0);
    CHECK(nlohmann::json::parse(same.out).at("mse") == 0);
    const ProcessResult rest = run_diptych(folder, {"compare", folder.file("a1.exr"), folder.file("a0.exr"), "--minus",
                                                    folder.file("a0.exr") + "," + folder.file("a0.exr"), "--json"});
    CHECK(nlohmann::json::parse(rest.out).at("mse") > 0);
    check_refusal(run_diptych(folder, {"compare", folder.file("a1.exr"), folder.file("a0.exr"), "--max-z", "4",
                                       "--minus", folder.file("a0.exr") + "," + folder.file("a0.exr")}),
                  2, {"--max-z"});
}

TEST_CASE("compare looks at the layers that are named, and where crops overlap", "[app]") {
    const TemporaryFolder folder;
    const auto part = [](const PixelWindow& data, const PixelWindow& display) {
        image_tests::ExrPart whole = image_tests::constant_part(data, {{"R", 1.0F}, {"G", 1.0F}, {"B", 1.0F}});
        whole.display = display;
        for (int i = 0; i < data.width * data.height; ++i) {  // each pixel holds its column in the display window
            whole.channels["R"][static_cast<std::size_t>(i)] = static_cast<float>(data.x + i % data.width);
        }
        return whole;
    };
    const auto write = [&](const std::string& name, const std::vector<image_tests::ExrPart>& parts) {
        write_file_atomically(folder.file(name), image_tests::exr_bytes(parts));
        return folder.file(name);
    };
    const PixelWindow display{0, 0, 12, 8};
    const std::string left = write("left.exr", {part({0, 0, 8, 6}, display)});
    const std::string right = write("right.exr", {part({4, 1, 8, 7}, display)});
    const ProcessResult crops = run_diptych(folder, {"compare", left, right, "--json", "-o", folder.file("f.png")});
    REQUIRE(crops.exit_code == 0);
    CHECK(nlohmann::json::parse(crops.out).at("mse") == 0);
    CHECK(contains(crops.err, "compared only where both have data: 4x5 pixels from 4,1"));
    CHECK(read_image(folder.file("f.png")).color.height == 5);
    CHECK(run_diptych(folder, {"compare", left, left, "--minus", right + "," + right}).exit_code == 0);

    const std::string corner = write("corner.exr", {part({10, 7, 2, 1}, display)});
    check_refusal(run_diptych(folder, {"compare", left, corner}), 2, {"left.exr", "corner.exr", "has data in both"});
    const std::string elsewhere = write("elsewhere.exr", {part({1, 0, 8, 6}, {1, 0, 12, 8})});
    check_refusal(run_diptych(folder, {"compare", left, elsewhere}), 2, {"left.exr", "0,0", "elsewhere.exr", "1,0"});
    check_refusal(run_diptych(folder, {"converge", generate_scene(folder, "cornell"), "-o", folder.file("c"), "--methods",
                                       "cpu:path", "--spp-max", "1", "--reference", left}),
                  2, {"--reference", "left.exr", "8x6 of its 12x8"});

    image_tests::ExrPart albedo = part(display, display), beauty = part(display, display);
    albedo.name = "albedo";
    beauty.name = "beauty";
    albedo.channels["G"].assign(96, 3.0F);
    const std::string parts = write("parts.exr", {albedo, beauty});
    const std::string whole = write("whole.exr", {part(display, display)});
    check_refusal(run_diptych(folder, {"compare", parts, whole}), 2, {"parts.exr", "FILE:LAYER (albedo, beauty)"});
    const auto mse = [&](const std::string& a) {
        return nlohmann::json::parse(run_diptych(folder, {"compare", a, whole, "--json"}).out).at("mse").get<double>();
    };
    CHECK(mse(parts + ":beauty") == 0);
    CHECK(mse(parts + ":albedo") == Approx(4.0 / 3));
    check_refusal(run_diptych(folder, {"compare", parts + ":depth", whole}), 2, {"parts.exr", "no layer 'depth'"});
}
