// Which clips of a scene play.
#include "pose/clips.h"

#include <cmath>

#include "catch.h"
#include "error.h"
#include "gltf_fixture.h"
#include "gltf/import.h"
#include "pose/pose.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// A clip of one channel that moves `node` to x = `to` in a second.
std::string clip(GltfBuilder& builder, const std::string& name, int node, float to) {
    const int times = builder.floats({0, 1}, "SCALAR", 2);
    const int path = builder.floats({0, 0, 0, to, 0, 0}, "VEC3", 2);
    return R"({"name":")" + name + R"(","samplers":[{"input":)" + std::to_string(times) + R"(,"output":)" +
           std::to_string(path) + R"(}],"channels":[{"sampler":0,"target":{"path":"translation","node":)" +
           std::to_string(node) + "}}]}";
}

/// Clips "walk" and "1" for node 0, and "0" for node 1.
Scene walking_scene() {
    GltfBuilder builder;
    builder.triangle();
    const std::string clips =
        clip(builder, "walk", 0, 2) + "," + clip(builder, "1", 0, 6) + "," + clip(builder, "0", 1, 8);
    const TemporaryFolder folder;
    return load_gltf(folder.write(
        "walking.gltf", builder.text(R"("nodes":[{"mesh":0},{"mesh":0}],"animations":[)" + clips +
                                     R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])")));
}

/// The places of both nodes after a second.
glm::dvec2 places(Scene scene) {
    pose_scene(scene, 1);
    return {scene.instances.at(0).object_to_world[3].x, scene.instances.at(1).object_to_world[3].x};
}

}  // namespace

TEST_CASE("of two clips for one node the first plays, with one warning, and clips of other nodes play too", "[clips]") {
    Scene scene = walking_scene();
    CHECK(scene.animations.size() == 3);
    CHECK(scene.warnings.empty());
    play_all_clips(scene);
    CHECK(places(scene) == glm::dvec2(2, 8));
    REQUIRE(clip_warnings(scene).size() == 1);
    CHECK_THAT(clip_warnings(scene).lines()[0],
               Catch::Contains("clip 0 'walk'") && Catch::Contains("`clip`") && Catch::Contains("1 '1' does not play"));
}

TEST_CASE("a clip that is chosen plays alone, without a warning", "[clips]") {
    Scene scene = walking_scene();
    play_all_clips(scene);
    play_clip(scene, 1);
    CHECK(places(scene) == glm::dvec2(6, 0));
    CHECK(clip_warnings(scene).empty());
    play_clip(scene, 2);
    CHECK(places(scene) == glm::dvec2(0, 8));
}

TEST_CASE("a clip is found by its very name, else by its index", "[clips]") {
    const Scene scene = walking_scene();
    CHECK(find_clip(scene, "walk") == 0);
    CHECK(find_clip(scene, "1") == 1);  // its name too
    CHECK(find_clip(scene, "0") == 2);  // a name before an index
    CHECK(find_clip(scene, "2") == 2);
    CHECK_THROWS_WITH(find_clip(scene, "wlak"),
                      Catch::Contains("walking.gltf: no clip 'wlak' (did you mean 'walk'?)") &&
                          Catch::Contains("0 'walk', 1 '1', 2 '0'"));
    CHECK_THROWS_WITH(find_clip(scene, "3"), Catch::Contains("no clip '3'"));
    CHECK_THROWS_WITH(find_clip(Scene{}, "0"), Catch::Contains("there are none"));
}

TEST_CASE("a scene whose chosen clip moves nothing stands still", "[clips]") {
    Scene scene = walking_scene();
    CHECK(moves(scene));
    for (Animation& animation : scene.animations) {
        for (Channel& channel : animation.channels) {
            channel.plays = false;
        }
    }
    CHECK_FALSE(moves(scene));
    CHECK(duration(scene) == 0);
    CHECK(places(scene) == glm::dvec2(0));
}
