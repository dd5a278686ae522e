// Any-hit shaders: a surface that is not opaque in front of one that is.
#include "gpu_fixture.h"

namespace diptych::core::tests {
namespace {

constexpr std::uint32_t front = 0;
constexpr std::uint32_t back = 1;

// Two unit squares across the z axis, at z = 1 (the front, with alpha) and z = 2.
PackedScene two_squares(std::uint32_t flags, float alpha, std::uint32_t features) {
    PackedScene packed = random_scene(1, 0, 0, 0);
    packed.materials.push_back(packed.materials.front());
    packed.materials[front].flags = flags;
    packed.materials[front].base_color.w = alpha;
    packed.materials[front].alpha_cutoff = 0.5F;
    packed.features = features;
    const std::vector<shared::uvec3> triangles = {{0, 1, 2}, {0, 2, 3}};
    for (const std::uint32_t which : {front, back}) {
        const float z = which == front ? 1.0F : 2.0F;
        packed.meshes.push_back({.first_geometry = which, .geometry_count = 0});
        add_geometry(packed, {{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}}, triangles, which);
        add_instance(packed, which, glm::mat4x3(1.0F));
    }
    return packed;
}

// Rays along the axis that differ in their keys alone; t_max lies between the squares.
std::vector<shared::RecordedRay> axis_rays(std::uint32_t count) {
    std::vector<shared::RecordedRay> rays;
    for (std::uint32_t i = 0; i < count; ++i) {
        rays.push_back(
            {.origin = {0.1F, 0.2F, 0}, .t_max = 1.5F, .direction = {0, 0, 1}, .alpha_key = i * 2654435761U});
    }
    return rays;
}

int count_front(const std::vector<TracedRay>& traced) {
    int count = 0;
    for (const TracedRay& ray : traced) {
        CHECK((ray.hit.instance == front || ray.hit.instance == back));
        CHECK(ray.blocked == (ray.hit.instance == front));
        count += ray.hit.instance == front ? 1 : 0;
    }
    return count;
}

}  // namespace

TEST_CASE("A mask below its cutoff is passed by closest and by shadow rays, above it is not") {
    NEED_VULKAN();
    const auto rays = axis_rays(64);
    CHECK(count_front(trace_rays(two_squares(shared::MATERIAL_ALPHA_MASK, 0.4F, shared::FEATURE_ALPHA), rays)) == 0);
    CHECK(count_front(trace_rays(two_squares(shared::MATERIAL_ALPHA_MASK, 0.6F, shared::FEATURE_ALPHA), rays)) == 64);
    check_no_validation_messages();
}

TEST_CASE("Blending stops a share of rays that is its alpha, by their keys: the same ones each time") {
    NEED_VULKAN();
    const auto rays = axis_rays(4096);
    const PackedScene packed = two_squares(shared::MATERIAL_ALPHA_BLEND, 0.3F, shared::FEATURE_ALPHA);
    const std::vector<TracedRay> traced = trace_rays(packed, rays);
    const int count = count_front(traced);
    CHECK(count > 4096 * 0.3 - 150);
    CHECK(count < 4096 * 0.3 + 150);
    const std::vector<TracedRay> again = trace_rays(packed, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        CHECK(traced[i].hit.instance == again[i].hit.instance);
    }
    check_no_validation_messages();
}

TEST_CASE("Without the feature there is no any-hit shader, and alpha is not looked at") {
    NEED_VULKAN();
    CHECK(count_front(trace_rays(two_squares(shared::MATERIAL_ALPHA_MASK, 0.0F, 0), axis_rays(64))) == 64);
    check_no_validation_messages();
}

}  // namespace diptych::core::tests
