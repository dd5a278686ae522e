// Scenes that move: what a file's animations do to the logical scene, and what is refused.
#include "pose/pose.h"

#include <cmath>

#include "catch.h"
#include "error.h"
#include "gltf_fixture.h"
#include "pose/clips.h"
#include "gltf/import.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// A file of some nodes and animations over one triangle (accessor 0), times 0 and 2 (accessor 1).
struct MovingFile {
    GltfBuilder builder;
    std::string nodes;
    std::string animation;  // members of animations[0]
    std::string more;       // members of the root, each with a comma before it

    MovingFile() {
        builder.triangle();
        builder.floats({0, 2}, "SCALAR", 2);
    }

    std::string text() const {
        return builder.text(
            R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + nodes +
            R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"animations":[{"name":"a",)" + animation +
            "}]" + more);
    }

    Scene load() const {
        const TemporaryFolder folder;
        return load_gltf(folder.write("moving.gltf", text()));
    }

    std::string refusal() const {
        const TemporaryFolder folder;
        const std::filesystem::path file = folder.write("moving.gltf", text());
        try {
            load_gltf(file);
        } catch (const Error& error) {
            const std::string message = error.what();
            CHECK(message.rfind(file.string() + ": ", 0) == 0);
            CHECK(message.find('\n') == std::string::npos);
            return message;
        }
        return "(was loaded)";
    }
};

std::string one_channel(int output, const std::string& target, const std::string& more = "") {
    return R"("samplers":[{"input":1,"output":)" + std::to_string(output) + more +
           R"(}],"channels":[{"sampler":0,"target":{)" + target + "}}]";
}

glm::dvec3 origin_of(const glm::dmat4& m) {
    return glm::dvec3(m[3]);
}

const char* const still_node = R"({"name":"n","mesh":0})";

}  // namespace

TEST_CASE("what hangs in a node that moves moves with it, at any time, and in any order of times", "[animation]") {
    MovingFile file;
    const int path = file.builder.floats({0, 0, 0, 4, 2, 0}, "VEC3", 2);
    file.nodes = R"({"children":[1,3]},{"translation":[9,9,9],"scale":[2,2,2],"children":[2]},)"
                 R"({"mesh":0,"camera":0,"translation":[1,0,0],"extensions":{"KHR_lights_punctual":{"light":0}}},)"
                 R"({"name":"still","mesh":0,"translation":[5,0,0]})";
    file.animation = one_channel(path, R"("node":1,"path":"translation")");
    file.more = R"(,"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}])"
                R"(,"extensionsUsed":["KHR_lights_punctual"])"
                R"(,"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}})";
    Scene scene = file.load();
    CHECK(scene.warnings.empty());
    CHECK(moves(scene));
    CHECK(duration(scene) == 2);
    REQUIRE(scene.instances.size() == 2);
    REQUIRE(scene.cameras.size() == 1);
    REQUIRE(scene.lights.size() == 1);
    CHECK(scene.nodes.size() == 3);  // the still one needs none
    CHECK(scene.instances[1].node == none);
    CHECK(origin_of(scene.instances[0].object_to_world) == glm::dvec3(11, 9, 9));  // at rest
    for (const double seconds : {2.0, 0.5, -1.0, 0.5, 7.0}) {
        INFO(seconds);
        pose_scene(scene, seconds);
        const double t = std::min(std::max(seconds, 0.0), 2.0) / 2;
        const glm::dvec3 expected(4 * t + 2, 2 * t, 0);
        CHECK(glm::length(origin_of(scene.instances[0].object_to_world) - expected) < 1e-14);
        CHECK(glm::length(origin_of(scene.cameras[0].camera_to_world) - expected) < 1e-14);
        CHECK(glm::length(origin_of(scene.lights[0].light_to_world) - expected) < 1e-14);
        CHECK(scene.instances[0].object_to_world[0] == glm::dvec4(2, 0, 0, 0));
        CHECK(scene.cameras[0].camera_to_world[0] == glm::dvec4(1, 0, 0, 0));
        CHECK(origin_of(scene.instances[1].object_to_world) == glm::dvec3(5, 0, 0));
    }
}

TEST_CASE("normalised and sparse keyframes are read as the specification says", "[animation]") {
    MovingFile file;
    file.nodes = still_node;
    // Half a turn about y, as normalised shorts.
    const int turns = file.builder.accessor(raw<std::int16_t>({0, 0, 0, 32767, 0, 32767, 0, 0}), 5122, "VEC4", 2,
                                            R"(,"normalized":true)");
    const int indices = file.builder.view(raw<std::uint8_t>({1}));
    const int values = file.builder.view(raw<float>({7, 8, 9}));
    const int path = file.builder.accessor_of(
        "", 5126, "VEC3", 2,
        R"(,"sparse":{"count":1,"indices":{"bufferView":)" + std::to_string(indices) +
            R"(,"componentType":5121},"values":{"bufferView":)" + std::to_string(values) + "}}");
    file.animation = R"("samplers":[{"input":1,"output":)" + std::to_string(turns) + R"(},{"input":1,"output":)" +
                     std::to_string(path) +
                     R"(}],"channels":[{"sampler":0,"target":{"node":0,"path":"rotation"}},)"
                     R"({"sampler":1,"target":{"node":0,"path":"translation"}}])";
    Scene scene = file.load();
    pose_scene(scene, 1);
    const glm::dmat4& m = scene.instances.at(0).object_to_world;
    CHECK(glm::length(m[0] - glm::dvec4(0, 0, -1, 0)) < 1e-7);
    CHECK(glm::length(origin_of(m) - glm::dvec3(3.5, 4, 4.5)) < 1e-6);
}

TEST_CASE("a node that grows from nothing keeps its place in the list", "[animation]") {
    MovingFile file;
    file.nodes = R"({"mesh":0,"scale":[0,0,0]})";
    const int sizes = file.builder.floats({0, 0, 0, 1, 1, 1}, "VEC3", 2);
    file.animation = one_channel(sizes, R"("node":0,"path":"scale")");
    Scene scene = file.load();
    CHECK(scene.warnings.empty());
    REQUIRE(scene.instances.size() == 1);
    pose_scene(scene, 2);
    CHECK(scene.instances[0].object_to_world == glm::dmat4(1));
}

TEST_CASE("emission and intensity follow KHR_animation_pointer, and other pointers are named once", "[animation]") {
    MovingFile file;
    const int strength = file.builder.floats({0, 8}, "SCALAR", 2);
    const int factor = file.builder.floats({1, 0.5F, 0, 0.5F, 0.5F, 1}, "VEC3", 2);
    file.nodes = R"({"mesh":0,"extensions":{"KHR_lights_punctual":{"light":0}}})";
    const auto pointer = [](int sampler, const std::string& text) {
        return R"({"sampler":)" + std::to_string(sampler) +
               R"(,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":{"pointer":")" + text + R"("}}}})";
    };
    file.animation = R"("samplers":[{"input":1,"output":)" + std::to_string(strength) + R"(},{"input":1,"output":)" +
                     std::to_string(factor) + R"(}],"channels":[)" +
                     pointer(0, "/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength") + "," +
                     pointer(1, "/materials/0/emissiveFactor") + "," +
                     pointer(0, "/extensions/KHR_lights_punctual/lights/0/intensity") + "," +
                     pointer(0, "/cameras/0/perspective/yfov") + "," + pointer(0, "/cameras/0/perspective/yfov") + "]";
    file.more =
        R"(,"materials":[{"emissiveFactor":[1,1,1]}])"
        R"(,"extensionsUsed":["KHR_lights_punctual","KHR_animation_pointer","KHR_materials_emissive_strength"])"
        R"(,"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","color":[1,0.25,0],"intensity":3}]}})";
    Scene scene = file.load();
    REQUIRE(scene.warnings.size() == 1);
    CHECK_THAT(scene.warnings.lines()[0], Catch::Contains("/cameras/0/perspective/yfov"));
    CHECK(scene.materials.at(0).emission == glm::vec3(1));
    CHECK(scene.lights.at(0).intensity == glm::vec3(3, 0.75F, 0));
    pose_scene(scene, 0);
    CHECK(scene.materials[0].emission == glm::vec3(0));
    CHECK(scene.materials[0].moving_emission);
    CHECK(scene.lights[0].intensity == glm::vec3(0));
    pose_scene(scene, 1);
    CHECK(glm::length(scene.materials[0].emission - glm::vec3(3, 2, 2)) < 1e-6F);
    CHECK(scene.lights[0].intensity == glm::vec3(4, 1, 0));
}

TEST_CASE("what cannot be played is a warning", "[animation]") {
    MovingFile file;
    file.nodes = still_node;
    const int weights = file.builder.floats({0, 1}, "SCALAR", 2);
    file.animation = one_channel(weights, R"("node":0,"path":"weights")");
    const Scene scene = file.load();
    REQUIRE(scene.warnings.size() == 1);
    CHECK_THAT(scene.warnings.lines()[0], Catch::Contains("morph targets"));
    CHECK(!moves(scene));
    file.animation = one_channel(weights, R"("path":"translation")");
    CHECK_THAT(file.load().warnings.lines().at(0), Catch::Contains("names no node"));
}

TEST_CASE("animations whose data cannot be read are refused, naming animation, channel and reason", "[animation]") {
    MovingFile file;
    file.nodes = still_node;
    const int good = file.builder.floats({0, 0, 0, 1, 1, 1}, "VEC3", 2);
    const int whole = file.builder.accessor(raw<std::uint16_t>({0, 1}), 5123, "SCALAR", 2);
    const std::string node = R"("node":0,"path":"translation")";
    const auto refused = [&](const std::string& animation, const std::string& object, const std::string& reason) {
        file.animation = animation;
        INFO(animation);
        CHECK_THAT(file.refusal(),
                   Catch::Contains("animations[0] (a)") && Catch::Contains(object) && Catch::Contains(reason));
    };
    const auto times = [&](int input) {
        return R"("samplers":[{"input":)" + std::to_string(input) + R"(,"output":)" + std::to_string(good) +
               R"(}],"channels":[{"sampler":0,"target":{)" + node + "}}]";
    };
    refused(one_channel(99, node), "channels[0]", "there is no accessors[99]");
    refused(one_channel(good, R"("node":7,"path":"translation")"), "channels[0]", "there is no nodes[7]");
    refused(one_channel(good, R"("node":0,"path":"rotation")"), "channels[0]", "4 are needed");
    refused(one_channel(good, node, R"(,"interpolation":"CUBICSPLINE")"), "output", "6 are needed");
    refused(times(whole), "input", "no floats");
    refused(R"("channels":[{"sampler":0,"target":{)" + node + "}}]", "channels[0].sampler", "samplers[0]");
    refused(R"("samplers":[],"channels":[{"target":{)" + node + "}}]", "channels[0].sampler", "missing");
    refused(R"("samplers":[{}],"channels":[{"sampler":0}])", "channels[0].target.path", "missing");
    refused(R"("samplers":[{}],"channels":[{"sampler":0,"target":{"path":"pointer"}}])", "channels[0]", "names none");
    refused(R"("samplers":[{}])", "channels", "missing");
}

TEST_CASE("faulty keyframes are repaired with a warning of their clip, and none of the scene", "[animation]") {
    MovingFile file;
    file.nodes = still_node;
    const int path = file.builder.floats({0, 0, 0, 4, 0, 0, 8, 0, 0}, "VEC3", 3);
    const std::string node = R"("node":0,"path":"translation")";
    // Where the node is at some moments, by its keys' times and what else the sampler has.
    const auto check = [&](std::initializer_list<float> times, const std::string& more, const std::string& warning,
                           const std::vector<std::pair<double, double>>& expected) {
        const int input = file.builder.floats(times, "SCALAR", 3);
        file.animation = R"("samplers":[{"input":)" + std::to_string(input) + R"(,"output":)" + std::to_string(path) +
                         more + R"(}],"channels":[{"sampler":0,"target":{)" + node + "}}]";
        Scene scene = file.load();
        INFO(warning);
        CHECK(scene.warnings.empty());
        REQUIRE(scene.animations.size() == 1);
        REQUIRE(scene.animations[0].warnings.size() == 1);
        CHECK_THAT(scene.animations[0].warnings.lines()[0],
                   Catch::Contains("animations[0] (a).channels[0].samplers[0]") && Catch::Contains(warning));
        CHECK(origin_of(scene.instances.at(0).object_to_world) == glm::dvec3(0));  // at rest
        for (const auto& [seconds, x] : expected) {
            INFO(seconds);
            pose_scene(scene, seconds);
            CHECK(std::abs(origin_of(scene.instances[0].object_to_world).x - x) < 1e-6);
        }
    };
    check({-1, 1, 2}, "", "has keys before 0 s; they are played from 0 s on: time 0 is -1", {{0, 2}, {1, 4}, {2, 8}});
    check({0, 1, 1}, "", "has two keys at one time; the value jumps there: time 2 is 1",
          {{0.5, 2}, {0.999, 3.996}, {1, 8}, {5, 8}});
    check({2, 0, 1}, "", "has keys that are not in order of time; they are sorted: time 1 is 0",
          {{0, 4}, {0.5, 6}, {1, 8}, {1.5, 4}, {2, 0}});
    check({0, 1, 2}, R"(,"interpolation":"QUINTIC")", "is unknown; taken as LINEAR: it is \"QUINTIC\"",
          {{0.5, 2}, {1.5, 6}});
    check({0, 1, 2}, R"(,"interpolation":7)", "is unknown; taken as LINEAR: it is 7", {{0.5, 2}});
}

TEST_CASE("keys of splines are sorted with their tangents", "[animation]") {
    MovingFile file;
    file.nodes = still_node;
    const int input = file.builder.floats({1, 0}, "SCALAR", 2);
    // From x = 0 to x = 1, leaving at a speed of 3 and arriving at rest: at half the way 0.5 + 3 / 8.
    const int path = file.builder.floats({0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0}, "VEC3", 6);
    file.animation = R"("samplers":[{"input":)" + std::to_string(input) + R"(,"output":)" + std::to_string(path) +
                     R"(,"interpolation":"HERMITE"}],)"
                     R"("channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}])";
    Scene scene = file.load();
    CHECK(scene.animations.at(0).warnings.size() == 2);
    CHECK_THAT(scene.animations[0].warnings.lines()[0], Catch::Contains("taken as CUBICSPLINE"));
    pose_scene(scene, 0.5);
    CHECK(std::abs(origin_of(scene.instances.at(0).object_to_world).x - 0.875) < 1e-6);
}

TEST_CASE("a channel whose keyframes cannot be repaired is left out with a warning of its clip", "[animation]") {
    MovingFile file;
    file.nodes = still_node;
    const int endless = file.builder.floats({0, 0, 0, 1, INFINITY, 1}, "VEC3", 2);
    const int no_turn = file.builder.floats({0, 0, 0, 1, 0, 0, 0, 0}, "VEC4", 2);
    const int never = file.builder.floats({0, NAN}, "SCALAR", 2);
    const std::string node = R"("node":0,"path":"translation")";
    const auto left_out = [&](const std::string& animation, const std::string& reason) {
        file.animation = animation;
        const Scene scene = file.load();
        INFO(reason);
        CHECK(scene.warnings.empty());
        CHECK_FALSE(moves(scene));
        REQUIRE(clip_warnings(scene).size() == 1);
        CHECK_THAT(clip_warnings(scene).lines()[0], Catch::Contains("animations[0] (a).channels[0]") &&
                                                        Catch::Contains(reason + "; left out"));
    };
    left_out(one_channel(endless, node), "has a value that is not finite");
    left_out(one_channel(no_turn, R"("node":0,"path":"rotation")"), "has a value that is no rotation");
    left_out(R"("samplers":[{"input":)" + std::to_string(never) + R"(,"output":)" + std::to_string(endless) +
                 R"(}],"channels":[{"sampler":0,"target":{)" + node + "}}]",
             "has a time that is not finite");
    file.nodes = R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]})";
    left_out(one_channel(1, node), "moves a node that has a matrix");
}

TEST_CASE("a camera whose scale passes through 0 looks where it looked", "[animation]") {
    MovingFile file;
    file.nodes = R"({"camera":0,"name":"eye"})";
    const int sizes = file.builder.floats({1, 1, 1, 0, 0, 0}, "VEC3", 2);
    file.animation = one_channel(sizes, R"("node":0,"path":"scale")");
    file.more = R"(,"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}])";
    Scene scene = file.load();
    pose_scene(scene, 1);
    const glm::dmat4 before = scene.cameras.at(0).camera_to_world;
    pose_scene(scene, 2);
    CHECK(scene.cameras.at(0).camera_to_world == before);
    scene.nodes.at(0).matrix = glm::dmat4(glm::dmat3(0));
    CHECK_THROWS_WITH(pose_scene(scene, 2), Catch::Contains("camera 'eye'") && Catch::Contains("2.0"));
}

TEST_CASE("animated assets pose without fault over their whole length", "[animation]") {
    const std::filesystem::path folder = asset_folder() / "gltf/khronos";
    if (!std::filesystem::exists(folder)) {
        SKIP_TEST("no assets at " + asset_folder().string());
    }
    std::size_t moving = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::filesystem::path extension = entry.path().extension();
        if (!entry.is_regular_file() || (extension != ".gltf" && extension != ".glb")) {
            continue;
        }
        INFO(entry.path().string());
        Scene scene;
        try {
            scene = load_gltf(entry.path());
        } catch (const Error&) {
            continue;  // gltf_assets.cpp says which may be refused
        }
        const double end = duration(scene);
        for (int i = -1; i <= 9 && moves(scene); ++i) {
            CHECK_NOTHROW(pose_scene(scene, end * i / 8));
        }
        moving += moves(scene) ? 1 : 0;
    }
    CHECK(moving >= 8);
}
