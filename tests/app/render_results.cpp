#include "catch.h"

#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>

#include "image/layered_image.h"
#include "process.h"
#include "generate/shapes.h"
#include "gltf/write.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// A floor of 2 metres and, half a metre above it, a small square that faces it and emits `radiance`.
std::string write_label(const TemporaryFolder& folder, float radiance) {
    Scene scene;
    Primitive floor;
    floor.material = add_material(scene, make_material("grey", glm::vec3(0.5F), 0, 1));
    add_quad(floor, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
    add_object(scene, "floor", {floor});
    Primitive label;
    label.material = add_material(scene, make_emitter("label", glm::vec3(radiance)));
    add_quad(label, {-0.05F, 0.5F, -0.05F}, {0.05F, 0.5F, -0.05F}, {0.05F, 0.5F, 0.05F}, {-0.05F, 0.5F, 0.05F});
    add_object(scene, "label", {label});
    scene.cameras.push_back(make_camera("camera", {0, 2, 2}, {0, 0, 0}, 60));
    const std::string file = folder.file("label.gltf");
    write_gltf(scene, file);
    return file;
}

ProcessResult render_result(const TemporaryFolder& folder, const std::string& scene, const std::string& output,
                            const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render", scene, "-o", folder.file(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessResult result = run_diptych(folder, arguments);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return result;
}

LayeredImage rendered(const TemporaryFolder& folder, const std::string& scene, const std::string& output,
                      const std::vector<std::string>& more) {
    render_result(folder, scene, output, more);
    return read_image(folder.file(output));
}

/// The words of a command line without quotes in it.
}  // namespace

TEST_CASE("render --json has the fields that scripts rely on", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const ProcessResult result =
        render_result(folder, scene, "out.exr", {"--spp", "4", "--size", "24x16", "--integrator", "direct", "--json"});
    const auto json = nlohmann::json::parse(result.out);
    CHECK(json.at("backend") == "cpu");
    CHECK_FALSE(json.at("device").get<std::string>().empty());
    CHECK(json.at("integrator") == "direct");
    CHECK(json.at("width") == 24);
    CHECK(json.at("height") == 16);
    CHECK(json.at("spp") == 4);
    CHECK(json.at("seconds").get<double>() > 0);
    CHECK(json.at("rays").get<double>() >= 24 * 16 * 4);
    CHECK(json.at("nonfinite") == 0);
    CHECK(json.at("output") == folder.file("out.exr"));
    CHECK(json.at("interrupted") == false);
    CHECK(json.at("build_seconds").get<double>() >= 0);
    CHECK(json.at("compile_seconds").get<double>() >= 0);
    CHECK(json.at("device_seconds").get<double>() > 0);
    CHECK(json.at("bytes").get<double>() > 0);
    CHECK(json.at("features").size() > 0);
    CHECK(json.at("samples_per_second").get<double>() > 0);
    CHECK(json.at("rays_per_second").get<double>() > 0);
}

TEST_CASE("the EXR's stored command repeats its picture to the bit", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string sampler = GENERATE("sobol", "hammersley");
    const LayeredImage first =
        rendered(folder, scene, "out.exr",
                 {"--spp",       "3",           "--size",      "20",   "--seed",  "9",       "--sampler", sampler,
                  "--brdf",      "blinn-phong", "--max-depth", "3",    "--mis",   "balance", "--env",     "0.1,0.2,0.3",
                  "--light-sampler", "uniform",
                  "--env-scale", "0.7",         "--aperture",  "0.01", "--focus", "1"});
    const std::string command = first.metadata.at("command");
    std::vector<std::string> words = words_of(command);
    REQUIRE(words.at(0) == "diptych");
    words.erase(words.begin());
    std::filesystem::remove(folder.file("out.exr"));
    const ProcessResult again = run_diptych(folder, words);
    INFO(command << "\n" << again.err);
    REQUIRE(again.exit_code == 0);
    const LayeredImage second = read_image(folder.file("out.exr"));
    CHECK(second.color.data == first.color.data);
    CHECK(second.standard_error->data == first.standard_error->data);
    CHECK(second.metadata.at("command") == command);
    CHECK(first.metadata.at("seed") == "9");
    CHECK(first.metadata.at("spp") == "3");
    CHECK(first.metadata.at("backend") == "cpu");
    CHECK(first.metadata.at("program").find("commit") != std::string::npos);
}

TEST_CASE("a seed gives one picture, whatever the threads, and another seed another", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::vector<std::string> common = {"--spp", "4", "--size", "40", "--seed"};
    const auto with = [&](const std::string& seed, const std::string& threads) {
        std::vector<std::string> more = common;
        more.insert(more.end(), {seed, "--threads", threads});
        return rendered(folder, scene, "out.exr", more);
    };
    const LayeredImage one = with("5", "1");
    const LayeredImage two = with("5", "2");
    CHECK(one.color.data == two.color.data);
    CHECK(one.standard_error->data == two.standard_error->data);
    CHECK(one.albedo->data == two.albedo->data);
    CHECK(with("6", "2").color.data != two.color.data);
}

TEST_CASE("EXR has the layers, unless told otherwise, and PNG and HDR have the picture", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const LayeredImage full = rendered(folder, scene, "full.exr", {"--spp", "2", "--size", "16"});
    CHECK(full.standard_error);
    CHECK(full.albedo);
    CHECK(full.normal);
    CHECK(full.depth);
    const LayeredImage bare = rendered(folder, scene, "bare.exr", {"--spp", "2", "--size", "16", "--no-layers"});
    CHECK_FALSE(bare.standard_error);
    CHECK_FALSE(bare.depth);
    CHECK(bare.color.data == full.color.data);
    const LayeredImage dark = rendered(folder, scene, "a.png", {"--spp", "2", "--size", "16", "--exposure", "-6"});
    const LayeredImage bright = rendered(folder, scene, "b.png", {"--spp", "2", "--size", "16", "--exposure", "0"});
    CHECK(dark.color.at(8, 8, 0) < bright.color.at(8, 8, 0));
    const LayeredImage hdr = rendered(folder, scene, "c.hdr", {"--spp", "2", "--size", "16"});
    CHECK(hdr.color.at(8, 8, 0) == Approx(full.color.at(8, 8, 0)).epsilon(0.02));
}

TEST_CASE("a scene without light or camera is seen under a neutral sky, with a warning each", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = write_bare_triangle(folder);
    const ProcessResult result = render_result(folder, scene, "out.exr", {"--spp", "1", "--size", "16"});
    CHECK(result.err.find("warning: " + scene + ": the scene has no light") != std::string::npos);
    CHECK(result.err.find("warning: " + scene + ": the scene has no camera") != std::string::npos);
    const LayeredImage image = read_image(folder.file("out.exr"));
    CHECK(image.color.width == 16);
    CHECK(image.color.at(0, 0, 1) > 0);
    const ProcessResult lit = render_result(folder, scene, "out.exr", {"--spp", "1", "--size", "16", "--env", "2,3,4"});
    CHECK(lit.err.find("no light") == std::string::npos);
    const LayeredImage sky = read_image(folder.file("out.exr"));
    CHECK(sky.color.at(0, 0, 0) == 2);
    CHECK(sky.color.at(0, 0, 2) == 4);
    render_result(folder, scene, "out.exr", {"--spp", "1", "--size", "16", "--env", "2,3,4", "--env-scale", "0.5"});
    CHECK(read_image(folder.file("out.exr")).color.at(0, 0, 1) == 1.5F);
    render_result(folder, scene, "out.exr", {"--spp", "1", "--size", "16", "--env", "0,0,0"});
    CHECK(read_image(folder.file("out.exr")).color.at(0, 0, 0) == 0);
}

TEST_CASE("a label does not switch the neutral sky off, and --env none does", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = write_label(folder, 1);
    const std::vector<std::string> small = {"--spp", "4", "--size", "16", "--max-depth", "2"};
    const auto shown = [&](std::vector<std::string> more, std::string& said) {
        more.insert(more.end(), small.begin(), small.end());
        said = render_result(folder, scene, "out.exr", more).err;
        return read_image(folder.file("out.exr"));
    };
    std::string said;
    const LayeredImage lit = shown({}, said);
    CHECK(said.find("warning: " + scene + ": what emits in the scene is too weak to light it: lit by a neutral sky") !=
          std::string::npos);
    CHECK(said.find("--env none") != std::string::npos);
    CHECK(lit.color.at(4, 9, 1) > 0.3F);  // the floor
    CHECK(lit.metadata.at("env") == "neutral");
    CHECK(lit.metadata.at("command").find("--env neutral") != std::string::npos);
    const LayeredImage asked = shown({"--env", "neutral"}, said);
    CHECK(said.find("sky") == std::string::npos);
    CHECK(asked.color.data == lit.color.data);
    const LayeredImage dark = shown({"--env", "none"}, said);
    CHECK(said.find("sky") == std::string::npos);
    CHECK(dark.color.at(0, 0, 1) == 0);
    CHECK(dark.metadata.at("env") == "none");
    const LayeredImage sunny = shown({"--sun", "0,60,1"}, said);  // a light that was asked for is light enough
    CHECK(said.find("sky") == std::string::npos);
    CHECK(sunny.metadata.count("env") == 0);
    write_label(folder, 40);  // and so is a lamp
    const LayeredImage lamp = shown({}, said);
    CHECK(said.find("sky") == std::string::npos);
    CHECK(lamp.color.at(0, 0, 1) == 0);
    CHECK(lamp.metadata.count("env") == 0);
}

TEST_CASE("pictures of 8 bits have the default tone map of the view", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const auto picture = [&](std::vector<std::string> more) {
        more.insert(more.end(), {"--spp", "2", "--size", "16"});
        return rendered(folder, scene, "out.png", more).color.data;
    };
    CHECK(picture({}) == picture({"--tonemap", "pbr-neutral"}));
    CHECK(picture({}) != picture({"--tonemap", "none"}));
    for (const char* command : {"render", "view", "compare"}) {
        const std::string help = run_diptych(folder, {command, "--help"}).out;
        const std::size_t option = help.find("--tonemap TEXT");
        REQUIRE(option != std::string::npos);
        // CLI11 writes the default behind "=", or from 2.4 on in brackets.
        CHECK(help.substr(option, 40).find("pbr-neutral") != std::string::npos);
    }
}

TEST_CASE("a render with --time ends on time", "[app][timed]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const double seconds = seconds_taken(1.5, [&] {
        const ProcessResult result = render_result(folder, scene, "out.exr", {"--time", "1.5", "--size", "32", "--json"});
        const auto json = nlohmann::json::parse(result.out);
        CHECK(json.at("spp").get<int>() > 1);
        CHECK(json.at("interrupted") == false);
        CHECK(result.err.find("spp") != std::string::npos);
        return result;
    });
    CHECK(seconds == Approx(1.5).epsilon(0.05));
}

TEST_CASE("an interrupt saves the work so far and ends with 130", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::string out = folder.file("out.exr");
    Process process(folder, {"render", scene, "-o", out, "--spp", "100000000", "--size", "32", "--json"});
    REQUIRE(process.wait_for_error_text("spp", 60));
    process.send(SIGINT);
    const ProcessResult result = process.finish();
    INFO(result.err);
    CHECK(result.exit_code == 130);
    const auto json = nlohmann::json::parse(result.out);
    CHECK(json.at("interrupted") == true);
    CHECK(json.at("spp").get<int>() > 0);
    CHECK_FALSE(std::filesystem::exists(out));
    const std::string part = folder.file("out.part.exr");
    CHECK(json.at("output") == part);
    const LayeredImage image = read_image(part);
    CHECK(image.metadata.at("interrupted") == "yes");
    CHECK(image.metadata.at("spp") == std::to_string(json.at("spp").get<int>()));
    CHECK(image.metadata.at("command").find("--spp " + image.metadata.at("spp") + " ") != std::string::npos);
    double sum = 0;
    for (const float value : image.color.data) {
        sum += value;
    }
    CHECK(std::isfinite(sum));
    CHECK(sum > 0);
}
