// What moves in random scenes, and that files say so.
#include <map>

#include "random_fixture.h"
#include "random_scene/scene_files.h"
#include "random_scene/shrink.h"
#include "pose/pose.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// What hangs in a node, or below it.
bool carries(const Scene& scene, int mover, int node) {
    while (node != none && node != mover) {
        node = scene.nodes[std::size_t(node)].parent;
    }
    return node != none;
}

void count_targets(const RandomScene& random, const Channel& channel, std::map<std::string, int>& counts) {
    const Scene& scene = random.scene;
    const bool moves_node = channel.property == AnimatedProperty::translation ||
                            channel.property == AnimatedProperty::rotation || channel.property == AnimatedProperty::scale;
    if (!moves_node) {
        return;
    }
    for (const Instance& instance : scene.instances) {
        if (!carries(scene, channel.target, instance.node)) {
            continue;
        }
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const Material& material = scene.materials[std::size_t(mesh.primitives[0].material)];
        ++counts[material.emission == glm::vec3(0) ? "mesh moves" : "lamp moves"];
        counts["mesh below a moving parent"] += channel.target != instance.node;
        counts["mesh goes"] += channel.property == AnimatedProperty::scale &&
                               channel.interpolation == Interpolation::step && channel.values[3] == 0;
    }
    for (const PunctualLight& light : scene.lights) {
        const char* names[] = {"point light moves", "spot light moves", "directional light moves"};
        counts[names[int(light.type)]] += carries(scene, channel.target, light.node);
    }
    counts["camera moves"] += carries(scene, channel.target, scene.cameras[std::size_t(random.settings.camera)].node);
}

void count_channel(const RandomScene& random, const Channel& channel, std::map<std::string, int>& counts) {
    const char* properties[] = {"translation",     "rotation",          "scale",
                                "emissive factor", "emissive strength", "light intensity"};
    const char* interpolations[] = {"STEP", "LINEAR", "CUBICSPLINE"};
    ++counts[std::string(properties[int(channel.property)]) + " " + interpolations[int(channel.interpolation)]];
    if (channel.property == AnimatedProperty::light_intensity) {
        const float first = channel.values[channel.interpolation == Interpolation::cubic_spline ? 1 : 0];
        ++counts[first == 0 ? "light begins dark" : "light begins lit"];
        counts["only light"] += random.scene.lights.size() == 1;
    }
    if (channel.property == AnimatedProperty::emissive_factor || channel.property == AnimatedProperty::emissive_strength) {
        const bool textured = random.scene.materials[std::size_t(channel.target)].emission_texture.texture != none;
        ++counts[textured ? "textured lamp switches" : "plain lamp switches"];
    }
    count_targets(random, channel, counts);
}

std::map<std::string, int> count_motion(std::uint64_t seeds) {
    std::map<std::string, int> counts;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const RandomScene random = make_moving_random_scene(seed);
        double begin = 1;
        for (const Animation& animation : random.scene.animations) {
            for (const Channel& channel : animation.channels) {
                count_channel(random, channel, counts);
                begin = std::min(begin, double(channel.times.front()));
            }
        }
        const double end = duration(random.scene);
        counts["all stops at frame 2"] += end <= 2 / random_fps;
        counts["moves to the last frame"] += end > 3 / random_fps;
        counts["rests at frames 0 and 1"] += begin >= 1 / random_fps;
        const ResamplingSettings& resampling = random.settings.resampling;
        counts["temporal"] += resampling.temporal;
        counts["spatial alone"] += !resampling.temporal && resampling.spatial_passes > 0;
        counts["visibility in the target"] += resampling.visibility == ResamplingVisibility::target;
        counts["balance"] += resampling.mis == ResamplingMis::balance;
    }
    return counts;
}

double apart(const glm::dmat4& a, const glm::dmat4& b) {
    double sum = 0;
    for (int column = 0; column < 4; ++column) {
        sum += glm::length(a[column] - b[column]);
    }
    return sum;
}

/// The farthest that any instance is from the like one of the other scene; files may have another order.
double instances_apart(const Scene& a, const Scene& b) {
    double worst = 0;
    for (const Instance& one : a.instances) {
        double nearest = 1e9;
        for (const Instance& other : b.instances) {
            if (a.meshes[std::size_t(one.mesh)].name == b.meshes[std::size_t(other.mesh)].name) {
                nearest = std::min(nearest, apart(one.object_to_world, other.object_to_world));
            }
        }
        worst = std::max(worst, nearest);
    }
    return worst;
}

void check_alike(const Scene& drawn, const Scene& read) {
    REQUIRE(read.instances.size() == drawn.instances.size());
    REQUIRE(read.lights.size() == drawn.lights.size());
    CHECK(instances_apart(drawn, read) < 1e-5);
    for (std::size_t i = 0; i < drawn.cameras.size(); ++i) {
        CHECK(apart(drawn.cameras[i].camera_to_world, read.cameras[i].camera_to_world) < 1e-5);
    }
    for (const PunctualLight& light : drawn.lights) {
        bool found = false;
        for (const PunctualLight& other : read.lights) {  // which may have another order
            if (other.name == light.name) {
                found = true;
                CHECK(apart(light.light_to_world, other.light_to_world) < 1e-5);
                CHECK(glm::length(light.intensity - other.intensity) < 1e-4);
            }
        }
        CHECK(found);
    }
    for (std::size_t i = 0; i < drawn.materials.size(); ++i) {
        CHECK(glm::length(drawn.materials[i].emission - read.materials[i].emission) < 1e-4);
    }
}

bool switches_a_light(const RandomScene& random) {
    for (const Animation& animation : random.scene.animations) {
        for (const Channel& channel : animation.channels) {
            if (channel.property == AnimatedProperty::light_intensity) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace

TEST_CASE("Moving random scenes move everything that can move") {
    const std::map<std::string, int> counts = count_motion(300);
    CHECK(counts.size() == 38);  // every feature that count_motion names was met
    for (const auto& [feature, count] : counts) {
        INFO(feature << ": " << count);
        CHECK(count >= 8);
    }
}

TEST_CASE("At rest a moving random scene is the still one of its seed") {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        INFO("seed " << seed);
        const TestFolder folder;
        const RandomScene moving = make_moving_random_scene(seed);
        write_random_scene(moving, folder.file("scene.gltf"));
        check_alike(make_random_scene(seed).scene, read_random_scene(moving, folder.file("scene.gltf")));
    }
}

TEST_CASE("A moving random scene is read back as it was drawn, at every frame") {
    const TestFolder folder;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const RandomScene random = make_moving_random_scene(seed);
        write_random_scene(random, folder.file("scene.gltf"));
        Scene drawn = random.scene;
        Scene read = read_random_scene(random, folder.file("scene.gltf"));
        REQUIRE(moves(read));
        for (std::uint32_t frame = 0; frame < random.frames; ++frame) {
            INFO("seed " << seed << ", frame " << frame);
            pose_scene(drawn, frame / random_fps);
            pose_scene(read, frame / random_fps);
            check_alike(drawn, read);
        }
    }
}

TEST_CASE("Shrinking a scene that moves leaves the channel that fails", "[nightly]") {
    int shrunk = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const RandomScene random = make_moving_random_scene(seed);
        if (!switches_a_light(random)) {
            continue;
        }
        ++shrunk;
        INFO("seed " << seed);
        const TestFolder folder;
        const auto still_fails = [&](const RandomScene& smaller) {
            write_random_scene(smaller, folder.file("scene.gltf"));
            Scene read = read_random_scene(smaller, folder.file("scene.gltf"));
            pose_scene(read, 1 / random_fps);
            return switches_a_light(smaller);
        };
        const RandomScene small = shrink(random, still_fails, 2000);
        std::size_t channels = 0;
        for (const Animation& animation : small.scene.animations) {
            channels += animation.channels.size();
        }
        CHECK(channels == 1);
        CHECK(small.scene.lights.size() == 1);
        CHECK(small.scene.instances.size() == 1);
        CHECK(small.scene.nodes.empty());
        CHECK(small.frames == random.frames);
    }
    CHECK(shrunk > 4);
}
