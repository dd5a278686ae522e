// The light tree against its lights: who is where, what each child emits, and that all can be picked.
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "generate/generate.h"
#include "lights/light_tree.h"
#include "pack/pack_parts.h"
#include "pack_fixture.h"
#include "pose/pose.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

constexpr std::size_t children = shared::LIGHT_NODE_WIDTH;

RenderSettings spatial_settings() {
    RenderSettings s = brdf_settings();
    s.integrator = Integrator::path;
    s.light_sampler = LightSampler::spatial;
    return s;
}

/// Lamps along a street, punctual lights of each kind, and a sky.
Scene lit_street(std::uint64_t lamps, std::size_t suns) {
    GenerateOptions options;
    options.count = lamps;
    Scene scene = generate_scene("many-lights", options).scene;
    PunctualLight point;
    point.light_to_world[3] = {1, 2, 3, 1};
    point.intensity = glm::vec3(5);
    PunctualLight spot = point;
    spot.type = PunctualType::spot;
    spot.light_to_world[3] = {4, 3, -2, 1};
    scene.lights = {point, spot};
    for (std::size_t i = 0; i < suns; ++i) {
        PunctualLight sun;
        sun.type = PunctualType::directional;
        sun.intensity = glm::vec3(1 + static_cast<float>(i));
        scene.lights.push_back(sun);
    }
    scene.environment.kind = Environment::Kind::constant;
    scene.environment.scale = glm::vec3(0.5F);
    return scene;
}

std::size_t light_count(const PackedScene& packed) {
    return packed.emissive_triangles.size() + packed.punctual_lights.size() + 1;
}

bool is_leaf(std::uint32_t child) {
    return (child & shared::LIGHT_LEAF) != 0;
}

std::vector<std::uint32_t> lights_of_leaf(const PackedScene& packed, std::uint32_t child) {
    const auto first = packed.leaf_picks.begin() + (child & shared::LIGHT_LEAF_FIRST);
    std::vector<std::uint32_t> lights;
    for (auto pick = first; pick != first + shared::leaf_size(child); ++pick) {
        lights.push_back(pick->light);
    }
    return lights;
}

/// Probability that the tree gives a light: a walk from its leaf to the root.
double probability(const PackedScene& packed, std::size_t light, const glm::vec3& position, const glm::vec3& normal) {
    shared::LightPlace place = packed.light_places[light];
    double p = static_cast<double>(place.share);
    while (place.slot != shared::NONE) {
        const std::size_t node = place.slot / children;
        const shared::LightWeights weights = shared::light_weights(packed.light_nodes[node], position, normal);
        p *= static_cast<double>(shared::child_probability(weights, place.slot % children));
        place = packed.light_places[light_count(packed) + node];
    }
    return p;
}

struct Reference {
    glm::vec3 position;
    glm::vec3 normal;
};

std::vector<Reference> references(float extent) {
    std::mt19937_64 random(7);
    std::normal_distribution<float> normal;
    std::vector<Reference> out;
    for (int i = 0; i < 12; ++i) {
        const glm::vec3 at(normal(random), normal(random), normal(random));
        out.push_back({extent * at, glm::normalize(glm::vec3(normal(random), normal(random), normal(random)))});
    }
    return out;
}

/// All lights' probabilities sum to 1, and all of positive power have one.
void check_probabilities(const PackedScene& packed, const Reference& from) {
    double sum = 0;
    for (std::size_t light = 0; light < light_count(packed); ++light) {
        if (light + 1 == light_count(packed) && packed.constants.environment.pmf == 0) {
            continue;
        }
        const double p = probability(packed, light, from.position, from.normal);
        CHECK((p > 0) == (packed.light_powers[light] > 0));
        sum += p;
    }
    CHECK(sum == Approx(1).epsilon(1e-5));
}

struct Sum {
    double weight = 0;
    glm::dvec3 center{0};
    glm::dvec3 axis{0};
    double square = 0;  // of the distance from the origin
};

/// From the corners of triangles, which share no code with the packer. One-sided triangles only.
Sum sum_of(const PackedScene& packed, std::uint32_t child) {
    Sum sum;
    if (!is_leaf(child)) {
        for (const std::uint32_t below : packed.light_nodes[child].child) {
            const Sum part = below == 0 ? Sum() : sum_of(packed, below);
            sum.weight += part.weight;
            sum.center += part.center;
            sum.axis += part.axis;
            sum.square += part.square;
        }
        return sum;
    }
    for (const std::uint32_t id : lights_of_leaf(packed, child)) {
        const shared::EmissiveTriangle& light = packed.emissive_triangles.at(id);
        const double weight = packed.light_powers[id] / std::numbers::pi;
        const glm::dvec3 a(light.vertex_0);
        const glm::dvec3 b = a + glm::dvec3(light.edge_1);
        const glm::dvec3 c = a + glm::dvec3(light.edge_2);
        const glm::dvec3 center = (a + b + c) / 3.0;
        double corners = 0;
        for (const glm::dvec3& corner : {a, b, c}) {
            corners += glm::dot(corner - center, corner - center);
        }
        sum.weight += weight;
        sum.center += weight * center;
        sum.axis += weight * glm::dvec3(light.front);
        sum.square += weight * (glm::dot(center, center) + corners / 12);
    }
    return sum;
}

void check_nodes(const PackedScene& packed) {
    for (const shared::LightNode& node : packed.light_nodes) {
        double most = 0;
        std::array<Sum, children> sums;
        for (std::size_t i = 0; i < children; ++i) {
            sums[i] = node.child[i] == 0 ? Sum() : sum_of(packed, node.child[i]);
            most = std::max(most, sums[i].weight);
        }
        for (std::size_t i = 0; i < children; ++i) {
            const Sum& sum = sums[i];
            CHECK(static_cast<double>(node.power[i]) == Approx(sum.weight / most).epsilon(1e-5));
            if (!(sum.weight > 0)) {
                continue;
            }
            const glm::dvec3 center = sum.center / sum.weight;
            const glm::dvec3 axis = sum.axis / sum.weight;
            const glm::dvec3 stored(node.center_x[i], node.center_y[i], node.center_z[i]);
            const double spread = sum.square / sum.weight - glm::dot(center, center);
            CHECK(glm::length(stored - center) < 1e-5 * (1 + glm::length(center)));
            CHECK(glm::length(glm::dvec3(node.axis_x[i], node.axis_y[i], node.axis_z[i]) - axis) < 1e-5);
            CHECK(static_cast<double>(node.spread[i]) == Approx(spread).epsilon(1e-3).margin(1e-6));
            CHECK(static_cast<double>(node.blur[i]) == Approx((1 - glm::dot(axis, axis)) / 4).epsilon(1e-3).margin(2e-4));
            CHECK(node.front[i] == 1);
            CHECK(node.place[i] == 1);
        }
    }
}

std::vector<std::uint32_t> form_of(const PackedScene& packed) {
    std::vector<std::uint32_t> form;
    for (const shared::LightNode& node : packed.light_nodes) {
        form.insert(form.end(), std::begin(node.child), std::end(node.child));
    }
    for (const shared::LightPlace& place : packed.light_places) {
        form.push_back(place.slot);
    }
    return form;
}

Scene lamps_alone(std::uint64_t count) {
    GenerateOptions options;
    options.count = count;
    Scene scene = generate_scene("many-lights", options).scene;
    scene.environment.kind = Environment::Kind::none;
    scene.lights.clear();
    return scene;
}

}  // namespace

TEST_CASE("Each light is in one leaf of the light tree, and its place says in which") {
    const PackedScene packed = pack_scene(lit_street(300, 13), spatial_settings());
    REQUIRE(packed.constants.light_sampler == shared::LIGHT_SAMPLER_SPATIAL);
    REQUIRE(packed.light_places.size() == light_count(packed) + packed.light_nodes.size());
    std::set<std::uint32_t> seen;
    std::set<std::uint32_t> nodes;
    for (std::uint32_t n = 0; n < packed.light_nodes.size(); ++n) {
        for (std::uint32_t i = 0; i < children; ++i) {
            const std::uint32_t child = packed.light_nodes[n].child[i];
            const std::uint32_t slot = n * shared::LIGHT_NODE_WIDTH + i;
            if (is_leaf(child)) {
                for (const std::uint32_t light : lights_of_leaf(packed, child)) {
                    CHECK(seen.insert(light).second);
                    CHECK(packed.light_places.at(light).slot == slot);
                }
            } else if (child != 0) {
                CHECK(nodes.insert(child).second);
                CHECK(child > n);
                CHECK(packed.light_places.at(light_count(packed) + child).slot == slot);
            }
        }
    }
    CHECK(seen.size() == light_count(packed));
    CHECK(nodes.size() + 1 == packed.light_nodes.size());
    CHECK(packed.light_places.at(light_count(packed)).slot == shared::NONE);
}

TEST_CASE("A child of the light tree emits what its lights emit together, from where they are") {
    const PackedScene packed = pack_scene(lamps_alone(500), spatial_settings());
    REQUIRE(packed.light_nodes.size() > 8);
    check_nodes(packed);
}

TEST_CASE("The light tree's probabilities sum to 1 everywhere, and leave out no light that shines") {
    for (const std::size_t suns : {0U, 1U, 4U, 13U}) {
        const PackedScene packed = pack_scene(lit_street(200, suns), spatial_settings());
        for (const Reference& from : references(10)) {
            check_probabilities(packed, from);
        }
        // On a light, and where all are far away.
        check_probabilities(packed, {packed.emissive_triangles[5].vertex_0, {0, 1, 0}});
        check_probabilities(packed, {glm::vec3(packed.punctual_lights[0].position), {0, -1, 0}});
        check_probabilities(packed, {{1e6F, 0, 1e6F}, {0, 1, 0}});
    }
}

TEST_CASE("No power and no distance takes the light tree's weights out of fp32's range") {
    for (const double power : {1e-12, 1.0, 1e12}) {
        for (const float extent : {1e-6F, 1.0F, 1e6F}) {
            CAPTURE(power, extent);
            PackedScene packed = pack_scene(lamps_alone(64), spatial_settings());
            for (std::size_t i = 0; i < packed.emissive_triangles.size(); ++i) {
                shared::EmissiveTriangle& light = packed.emissive_triangles[i];
                light.vertex_0 *= extent;
                light.edge_1 *= extent;
                light.edge_2 *= extent;
                packed.light_powers[i] *= i % 2 == 0 ? power : 1;
            }
            weigh_light_tree(packed);
            for (const Reference& from : references(10 * extent)) {
                double sum = 0;
                for (std::size_t i = 0; i < packed.emissive_triangles.size(); ++i) {
                    const double p = probability(packed, i, from.position, from.normal);
                    CHECK(p > 0);
                    sum += p;
                }
                CHECK(sum == Approx(1).epsilon(1e-5));
            }
        }
    }
}

TEST_CASE("Of lights of one power the near one is picked by the square of the distance, one that faces away hardly") {
    Scene scene = least_scene();
    const int glow = add_material(scene, make_emitter("glow", glm::vec3(1)));
    for (const float x : {-1.0F, 4.0F, 20.0F}) {  // the last one shines up
        Primitive square;
        square.material = glow;
        const float z = x > 10 ? -0.01F : 0.01F;
        add_quad(square, {x - 0.01F, 3, -z}, {x + 0.01F, 3, -z}, {x + 0.01F, 3, z}, {x - 0.01F, 3, z});
        add_object(scene, "lamp", {square});
    }
    const PackedScene packed = pack_scene(scene, spatial_settings());
    REQUIRE(packed.emissive_triangles.size() == 6);
    const glm::vec3 origin(glm::dvec3(0) - packed.origin);
    const auto of_lamp = [&](std::size_t k) {
        return probability(packed, 2 * k, origin, {0, 1, 0}) + probability(packed, 2 * k + 1, origin, {0, 1, 0});
    };
    REQUIRE(packed.emissive_triangles[0].front.y < 0);
    REQUIRE(packed.emissive_triangles[4].front.y > 0);
    // Both cosines are 3/d.
    CHECK(of_lamp(0) / of_lamp(1) == Approx(std::pow(25.0 / 10.0, 2)).epsilon(0.05));
    CHECK(of_lamp(2) < 1e-4);
}

TEST_CASE("A light tree whose lights move is formed at rest") {
    Scene scene = generate_scene("moving-light").scene;
    RenderSettings settings = spatial_settings();
    settings.light_sampler = LightSampler::power;
    PackedScene packed = pack_scene(scene, settings);
    settings.light_sampler = LightSampler::spatial;
    CHECK(!repack_settings(scene, settings, packed));
    packed = pack_scene(scene, settings);
    const std::vector<std::uint32_t> form = form_of(packed);
    pose_scene(scene, 1.5);
    settings.max_depth = 3;
    CHECK(repack_settings(scene, settings, packed));
    CHECK(form_of(packed) == form);
}

TEST_CASE("The light tree goes with its lights and keeps its form") {
    Scene scene = generate_scene("moving-light").scene;
    RenderSettings settings = spatial_settings();
    settings.moves = true;
    PackedScene packed = pack_scene(scene, settings);
    REQUIRE(!packed.light_nodes.empty());
    const std::vector<std::uint32_t> form = form_of(packed);
    const std::vector<shared::LightNode> before = packed.light_nodes;
    const std::uint64_t revision = packed.revisions.light_nodes;
    for (const double seconds : {0.5, 1.5, 3.0}) {
        INFO(seconds);
        pose_scene(scene, seconds);
        pack_moment(scene, settings, packed);
        CHECK(form_of(packed) == form);
        CHECK(packed.revisions.light_nodes != revision);
        for (const Reference& from : references(2)) {
            check_probabilities(packed, from);
        }
    }
    bool moved = false;
    for (std::size_t n = 0; n < before.size(); ++n) {
        for (std::size_t i = 0; i < children; ++i) {
            moved = moved || before[n].center_x[i] != packed.light_nodes[n].center_x[i] ||
                    before[n].power[i] != packed.light_nodes[n].power[i];
        }
    }
    CHECK(moved);
}

TEST_CASE("A scene with one light has no light tree, and picks that light by power") {
    RenderSettings settings = spatial_settings();
    for (const bool generic : {false, true}) {
        settings.generic = generic;
        const PackedScene packed = pack_scene(generate_scene("cornell").scene, settings);  // a lamp of two triangles
        CHECK(packed.light_nodes.empty());
        CHECK(packed.light_places.empty());
        CHECK(packed.leaf_picks.empty());
        CHECK(packed.constants.light_sampler == shared::LIGHT_SAMPLER_POWER);
        CHECK(((packed.features & shared::FEATURE_LIGHT_TREE) != 0) == generic);
    }
    Scene dark = least_scene();
    CHECK(pack_scene(dark, settings).light_nodes.empty());
}

TEST_CASE("The light tree comes and goes with the setting") {
    const Scene scene = lit_street(40, 1);
    RenderSettings settings = spatial_settings();
    settings.light_sampler = LightSampler::power;
    PackedScene packed = pack_scene(scene, settings);
    CHECK(packed.light_nodes.empty());
    CHECK((packed.features & shared::FEATURE_LIGHT_TREE) == 0);
    settings.light_sampler = LightSampler::spatial;
    REQUIRE(repack_settings(scene, settings, packed));
    const PackedScene fresh = pack_scene(scene, settings);
    CHECK(form_of(packed) == form_of(fresh));
    CHECK(packed.features == fresh.features);
    CHECK(packed.constants.light_sampler == shared::LIGHT_SAMPLER_SPATIAL);
    settings.light_sampler = LightSampler::uniform;
    REQUIRE(repack_settings(scene, settings, packed));
    CHECK(packed.light_nodes.empty());
    CHECK(packed.constants.light_sampler == shared::LIGHT_SAMPLER_UNIFORM);
    CHECK((packed.features & shared::FEATURE_LIGHT_TREE) == 0);
}
