// What moves and switches in a random scene: nodes under meshes, lights and cameras; emission and intensity.
#include <algorithm>
#include <cmath>

#include "random_scene/parts.h"

namespace diptych::core {

namespace {

using P = AnimatedProperty;
using I = Interpolation;

/// Frames within which everything happens: nothing changes up to `first`, nor after `last`.
struct Window {
    int first = 0;
    int last = 0;
};

Window random_window(Draws& draws) {
    Window window;
    window.last = draws.pick({2, 3, 4, 4});
    const bool rests = draws.chance(0.4);
    window.first = rests ? 1 + draws.below(window.last - 1) : 0;
    return window;
}

/// Keys that lead from one value to another, and perhaps back.
struct Keys {
    std::vector<float> times;
    std::vector<glm::dvec4> values;
};

Keys random_keys(Draws& draws, const Window& window, const glm::dvec4& rest, const glm::dvec4& other) {
    const int begin = window.first + draws.below(window.last - window.first);
    const int end = begin + 1 + draws.below(window.last - begin);
    const bool returns = draws.chance(0.4) && end < window.last;
    const bool reversed = draws.chance(0.4);
    const double early = begin > 0 && draws.chance(0.3) ? 0.5 : 0;  // keys between frames
    std::vector<int> frames{begin, end};
    if (returns) {
        frames.push_back(window.last);
    }
    Keys keys;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        keys.times.push_back(float((frames[i] - early) / random_fps));
        keys.values.push_back((i == 1) != reversed ? other : rest);
    }
    return keys;
}

void append(std::vector<float>& list, const glm::dvec4& value, int count) {
    for (int i = 0; i < count; ++i) {
        list.push_back(float(value[i]));
    }
}

class MotionMaker {
public:
    MotionMaker(RandomScene& out, Draws& draws)
        : scene_(out.scene), draws_(draws), window_(random_window(draws)), chosen_(std::size_t(out.settings.camera)) {
        scene_.animations = {{"nodes", {}, {}}, {"lights", {}, {}}};  // which play together
    }

    void add_all() {
        for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
            move_instance(i);
        }
        turn_inner_nodes();
        for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
            move_light(i);
        }
        move_cameras();
        for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
            switch_material(int(i));
        }
        if (scene_.animations[0].channels.empty() && scene_.animations[1].channels.empty()) {
            slide(hang(scene_.instances[0], scene_.instances[0].object_to_world), 0.8);
        }
        std::erase_if(scene_.animations, [](const Animation& a) { return a.channels.empty(); });
    }

private:
    I interpolation() { return draws_.pick({I::step, I::step, I::linear, I::cubic_spline}); }

    void add(P property, int target, I kind, const glm::dvec4& rest, const glm::dvec4& other) {
        const Keys keys = random_keys(draws_, window_, rest, other);
        const int count = component_count(property);
        Channel channel{property, target, kind, keys.times, {}};
        for (std::size_t k = 0; k < keys.values.size(); ++k) {
            if (kind != I::cubic_spline) {
                append(channel.values, keys.values[k], count);
                continue;
            }
            const std::size_t before = k - (k > 0 ? 1 : 0);
            const std::size_t after = std::min(k + 1, keys.values.size() - 1);
            const glm::dvec4 speed =
                (keys.values[after] - keys.values[before]) / double(keys.times[after] - keys.times[before]);
            append(channel.values, draws_.between(0, 1.5) * speed, count);
            append(channel.values, keys.values[k], count);
            append(channel.values, draws_.between(0, 1.5) * speed, count);
        }
        scene_.animations[property == P::translation || property == P::rotation || property == P::scale ? 0 : 1]
            .channels.push_back(std::move(channel));
    }

    void slide(int node, double distance) {
        const glm::dvec3 rest = scene_.nodes[std::size_t(node)].translation;
        add(P::translation, node, interpolation(), {rest, 0}, {rest + distance * draws_.direction(), 0});
    }

    /// `sine` of half the angle.
    void turn(int node, double sine) {
        const glm::dvec4 rest = scene_.nodes[std::size_t(node)].rotation;
        const glm::dvec3 axis = sine * draws_.direction();
        const double w = std::sqrt(1 - sine * sine);
        const glm::dvec3 v(rest);
        const glm::dvec4 turned(w * v + rest.w * axis + glm::cross(v, axis), w * rest.w - glm::dot(v, axis));
        add(P::rotation, node, interpolation(), rest, turned);
    }

    void grow(int node) {
        const glm::dvec3 rest = scene_.nodes[std::size_t(node)].scale;
        add(P::scale, node, interpolation(), {rest, 0}, {rest * draws_.within(0.4, 1.6), 0});
    }

    /// Flat for some frames, so that no ray meets it; or mirrored.
    void flip(int node) {
        const glm::dvec3 rest = scene_.nodes[std::size_t(node)].scale;
        glm::dvec3 other(0);
        if (draws_.chance(0.2)) {
            other = rest;
            other[draws_.below(3)] *= -1;
        }
        add(P::scale, node, I::step, {rest, 0}, {other, 0});
    }

    /// A node about which `thing`, now at `to_world`, can move; below another such node now and then. Those nodes come
    /// first of all, since parents come before their children.
    template <typename Thing>
    int hang(Thing& thing, const glm::dmat4& to_world) {
        const int mover = movers_;
        Node node;
        node.name = "mover" + std::to_string(mover);
        const glm::dvec3 pivot(to_world[3]);
        node.translation = pivot;
        if (mover > 0 && draws_.chance(0.2)) {
            node.parent = draws_.below(mover);
            node.translation -= pivots_[std::size_t(node.parent)];
        }
        insert_node(mover, node);
        pivots_.push_back(pivot);
        ++movers_;
        glm::dmat4 back(1);
        back[3] = glm::dvec4(-pivot, 1);
        int root = thing.node;
        while (root != none && scene_.nodes[std::size_t(root)].parent != none) {
            root = scene_.nodes[std::size_t(root)].parent;
        }
        if (root == none) {
            Node placed;
            placed.name = thing.name;
            placed.matrix = to_world;
            thing.node = root = int(scene_.nodes.size());
            scene_.nodes.push_back(placed);
        }
        Node& outer = scene_.nodes[std::size_t(root)];
        outer.matrix = back * node_matrix(outer);
        outer.parent = mover;
        return mover;
    }

    void insert_node(int at, const Node& node) {
        const auto shift = [at](int& index) { index += index >= at ? 1 : 0; };
        for (Node& other : scene_.nodes) {
            shift(other.parent);
        }
        for (Instance& instance : scene_.instances) {
            shift(instance.node);
        }
        for (PunctualLight& light : scene_.lights) {
            shift(light.node);
        }
        for (Camera& camera : scene_.cameras) {
            shift(camera.node);
        }
        for (Channel& channel : scene_.animations[0].channels) {
            shift(channel.target);
        }
        scene_.nodes.insert(scene_.nodes.begin() + at, node);
    }

    void move_instance(std::size_t i) {
        Instance& instance = scene_.instances[i];
        if (instance.name == room_name || !draws_.chance(0.5)) {
            return;
        }
        const int mover = hang(instance, instance.object_to_world);
        const bool switches = draws_.chance(0.4);
        if (switches) {
            flip(mover);
        } else if (draws_.chance(0.3)) {
            grow(mover);
        }
        if (draws_.chance(switches ? 0.3 : 0.7)) {
            slide(mover, draws_.between(0.4, 1.2));
        }
        if (draws_.chance(0.4)) {
            turn(mover, draws_.between(0.2, 1));
        }
    }

    /// Those in the chains of instances, movers aside.
    void turn_inner_nodes() {
        for (int i = movers_; i < int(scene_.nodes.size()); ++i) {
            if (scene_.nodes[std::size_t(i)].matrix || !draws_.chance(0.25)) {
                continue;
            }
            switch (draws_.below(3)) {
            case 0:
                turn(i, draws_.between(0.2, 1));
                break;
            case 1:
                grow(i);
                break;
            default:
                slide(i, draws_.between(0.2, 0.5));
            }
        }
    }

    void move_light(std::size_t i) {
        PunctualLight& light = scene_.lights[i];
        if (draws_.chance(0.5)) {
            const int mover = hang(light, light.light_to_world);
            const bool has_place = light.type != PunctualType::directional;
            if (has_place && draws_.chance(0.6)) {
                slide(mover, draws_.between(0.4, 1.2));
            } else {
                turn(mover, draws_.between(0.1, 1));
            }
        }
        if (draws_.chance(0.6)) {
            const double rest = double(light.intensity.x) / double(light.moving_color->x);
            add(P::light_intensity, int(i), interpolation(), glm::dvec4(rest), glm::dvec4(rest * random_factor()));
        }
    }

    void move_cameras() {
        for (std::size_t i = 0; i < scene_.cameras.size(); ++i) {
            Camera& camera = scene_.cameras[i];
            if (!draws_.chance(i == chosen_ ? 0.5 : 0.2)) {
                continue;
            }
            const int mover = hang(camera, camera.camera_to_world);
            if (draws_.chance(0.6)) {
                slide(mover, draws_.between(0.1, 0.5));
            } else {
                turn(mover, draws_.between(0.02, 0.06));
            }
        }
    }

    /// What a light is multiplied by: off, or brighter or dimmer.
    double random_factor() {
        if (draws_.chance(0.6)) {
            return 0;
        }
        return draws_.chance(0.5) ? draws_.between(0.1, 0.4) : draws_.between(2, 3);
    }

    void switch_material(int index) {
        Material& material = scene_.materials[std::size_t(index)];
        if (material.emission == glm::vec3(0) || !draws_.chance(0.5)) {
            return;
        }
        if (!material.moving_emission) {
            material.moving_emission = MovingEmission{material.emission, 1};
        }
        if (draws_.chance(0.6)) {
            const double rest = double(material.moving_emission->strength);
            add(P::emissive_strength, index, interpolation(), glm::dvec4(rest), glm::dvec4(rest * random_factor()));
        } else {
            const glm::dvec3 rest(material.moving_emission->factor);
            const glm::dvec3 other = draws_.chance(0.4) ? glm::dvec3(0) : draws_.within(0, 1);
            add(P::emissive_factor, index, interpolation(), {rest, 0}, {other, 0});
        }
    }

    Scene& scene_;
    Draws& draws_;
    Window window_;
    std::size_t chosen_;  // the camera that is rendered
    int movers_ = 0;      // the first nodes
    std::vector<glm::dvec3> pivots_;
};

}  // namespace

void add_random_motion(RandomScene& out, Draws draws) {
    out.frames = random_frames;
    MotionMaker(out, draws).add_all();
    // Without it no frame looks back; still scenes leave it out more often.
    out.settings.resampling.temporal |= draws.chance(0.6);
    // Frames are reused at the first vertex alone; more of them add noise.
    out.settings.max_depth = std::min(out.settings.max_depth, 3U);
}

}  // namespace diptych::core
