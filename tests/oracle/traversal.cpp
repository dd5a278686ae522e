// The oracle's rays against a loop over all triangles in double.
#include <cmath>
#include <random>

#include "catch.h"
#include "oracle/traversal.h"
#include "oracle_fixture.h"

namespace diptych::core::tests {

namespace {

using namespace oracle;

std::optional<Hit> nearest_by_loop(const World& world, const Ray& ray) {
    std::optional<Hit> nearest;
    for (std::size_t i = 0; i < world.triangles.size(); ++i) {
        // By signed volumes, not as the traversal intersects.
        const Triangle& t = world.triangles[i];
        const dvec3 a = t.a - ray.origin;
        const dvec3 b = t.b - ray.origin;
        const dvec3 c = t.c - ray.origin;
        const double u = dot(ray.direction, cross(b, c));
        const double v = dot(ray.direction, cross(c, a));
        const double w = dot(ray.direction, cross(a, b));
        const bool inside = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
        const double sum = u + v + w;
        if (!inside || sum == 0 || i == ray.from) {
            continue;
        }
        const double distance = dot(ray.direction, (u * a + v * b + w * c) / sum);
        if (distance > 0 && distance < ray.t_max && (!nearest || distance < nearest->t)) {
            nearest = Hit{i, dvec2(v, w) / sum, distance};
        }
    }
    return nearest;
}

struct Tally {
    int rays = 0;
    int hits = 0;
    int different = 0;  // another triangle, or hit against miss: rays that float sees on the other side of an edge
};

void compare(const World& world, const Traversal& traversal, const Ray& ray, Tally& tally) {
    const std::optional<Hit> truth = nearest_by_loop(world, ray);
    const std::optional<Hit> hit = traversal.closest(ray);
    ++tally.rays;
    tally.hits += truth ? 1 : 0;
    if (truth.has_value() != hit.has_value() || (truth && truth->triangle != hit->triangle)) {
        ++tally.different;
    } else if (truth) {
        CHECK(hit->t == Approx(truth->t).epsilon(1e-9));
        CHECK(length(hit->barycentrics - truth->barycentrics) < 1e-8);
        Ray shorter = ray;
        shorter.t_max = truth->t * (1 - 1e-6);
        CHECK_FALSE(traversal.any(shorter));
        shorter.t_max = truth->t * (1 + 1e-6);
        CHECK(traversal.any(shorter));
    } else {
        CHECK_FALSE(traversal.any(ray));
    }
}

dvec3 random_direction(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    const double x = normal(random);
    const double y = normal(random);
    return normalize(dvec3(x, y, normal(random)));
}

/// Rays from anywhere, and rays that leave the point where the last one arrived.
Tally compare_many(const World& world, int count) {
    const Traversal traversal(world);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> place(-world.extent, world.extent);
    Tally tally;
    for (int i = 0; i < count; ++i) {
        Ray ray;
        ray.origin.x = place(random);
        ray.origin.y = place(random);
        ray.origin.z = place(random);
        ray.direction = random_direction(random);
        compare(world, traversal, ray, tally);
        if (const std::optional<Hit> hit = traversal.closest(ray)) {
            Ray next;
            next.origin = point_on(world.triangles[hit->triangle], hit->barycentrics);
            next.direction = random_direction(random);
            next.from = hit->triangle;
            compare(world, traversal, next, tally);
        }
    }
    return tally;
}

Scene soup(int count, double offset) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<float> place(-1, 1);
    Scene scene;
    Primitive primitive;
    primitive.material = add_material(scene, lambertian(vec3(0.5F)));
    for (int i = 0; i < count; ++i) {
        vec3 corners[3];
        for (vec3& corner : corners) {
            corner = vec3(place(random), place(random), place(random));
        }
        for (const vec3& corner : corners) {
            primitive.positions.push_back(corners[0] + 0.4F * (corner - corners[0]));
        }
        primitive.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    glm::dmat4 matrix = translation(offset, 0, offset);
    matrix[1] = {0.3, -2, 0.1, 0};
    add_object(scene, "soup", {primitive}, matrix);
    return scene;
}

}  // namespace

TEST_CASE("the oracle's rays meet what a loop over a soup of triangles meets", "[oracle]") {
    for (const double offset : {0.0, 1e6}) {
        const Scene scene = soup(300, offset);
        const Tally tally = compare_many(make_world(scene), 4000);
        INFO(tally.different << " of " << tally.rays);
        CHECK(tally.hits > tally.rays / 8);
        CHECK(tally.different <= 2);
    }
}

TEST_CASE("the oracle's rays meet what a loop over a generated scene meets", "[oracle]") {
    const GeneratedScene generated = generate_scene("cornell");
    const Tally tally = compare_many(make_world(generated.scene), 4000);
    INFO(tally.different << " of " << tally.rays);
    CHECK(tally.hits > tally.rays / 8);
    CHECK(tally.different <= 2);
}

}  // namespace diptych::core::tests
