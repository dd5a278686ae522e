// The device under test, a scene of random triangles, and rays traced through it by trace_rays.rgen.
#pragma once

#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include "../../shaders/dispatch.h"
#include "structures/acceleration.h"
#include "geometry/hit.h"
#include "pack/packed_scene.h"
#include "vulkan_device.h"
#include "renderer/vulkan_renderer.h"

namespace diptych::core::tests {

/// Validation where the layer is installed, so that every test of a device is one of validation too.
VulkanOptions test_options();

/// The device itself, likewise.
std::shared_ptr<Gpu> open_test_gpu();

struct TracedRay {
    shared::Hit hit;
    bool blocked;
};

/// Rays from within [-3, 3]^3 in all directions, each with an end.
std::vector<shared::RecordedRay> random_rays(std::uint32_t seed, int count);

/// Traces closest and any hits on the device.
std::vector<TracedRay> trace_rays(const PackedScene& packed, const std::vector<shared::RecordedRay>& rays,
                                  const BuildLimits& limits = {}, const InstanceGroups& groups = {});

/// Whether two arrays have the same bits.
template <typename T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Bit for bit.
inline bool same_film(const Film& a, const Film& b) {
    return a.width == b.width && a.height == b.height && same_bytes(a.pixels, b.pixels) &&
           same_bytes(a.moments, b.moments) && same_bytes(a.first_hits, b.first_hits);
}

/// A generated scene, packed.
PackedScene generated_scene(const std::string& name, const RenderSettings& settings);

/// Meshes of a few primitives each, placed by random transforms: every second mirrored, all non-uniform. One grey
/// material.
PackedScene random_scene(std::uint32_t seed, std::uint32_t meshes, std::uint32_t instances, std::uint32_t triangles);

/// Adds an instance of a mesh.
void add_instance(PackedScene& packed, std::uint32_t mesh, const glm::mat4x3& object_to_world);

/// Adds a geometry to the last mesh.
void add_geometry(PackedScene& packed, const std::vector<shared::vec3>& positions,
                  const std::vector<shared::uvec3>& triangles, std::uint32_t material);

}  // namespace diptych::core::tests
