#include "gpu_fixture.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "structures/acceleration.h"
#include "pipelines/bindings.h"
#include "commands/commands.h"
#include "memory/film_memory.h"
#include "passes/pass_pipelines.h"
#include "renderer/path_renderer.h"
#include "pipelines/pipeline.h"
#include "generate/generate.h"
#include "test_shader_binaries.h"
#include "memory/upload.h"

namespace diptych::core::tests {

VulkanOptions test_options() {
    return {.device = "", .validation = has_validation_layer()};
}

std::shared_ptr<Gpu> open_test_gpu() {
    return open_gpu({.device = "", .validation = test_options().validation});
}

std::vector<shared::RecordedRay> random_rays(std::uint32_t seed, int count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    std::vector<shared::RecordedRay> rays;
    for (int i = 0; i < count; ++i) {
        shared::RecordedRay ray{};
        for (int k = 0; k < 3; ++k) {
            ray.origin[k] = 3.0F * uniform(random);
            ray.direction[k] = uniform(random);
        }
        ray.t_max = 0.5F + 2.0F * std::abs(uniform(random));
        ray.alpha_key = static_cast<std::uint32_t>(i);
        rays.push_back(ray);
    }
    return rays;
}

std::vector<TracedRay> trace_rays(const PackedScene& packed, const std::vector<shared::RecordedRay>& rays,
                                  const BuildLimits& limits, const InstanceGroups& groups) {
    const auto opened = open_test_gpu();
    const Gpu& gpu = *opened;
    const SceneMemory scene = upload_scene(gpu, packed);
    const BottomLevels bottom = build_bottom_levels(gpu, packed, scene, groups, limits);
    const TopLevel top = build_top_level(gpu, packed, bottom);
    const FilmMemory film = make_film(gpu, static_cast<int>(rays.size()), 1, shared::FEATURE_FIRST_HIT_LAYERS);
    Uploader uploader(gpu);
    const Buffer ray_buffer =
        upload_array(gpu, uploader, Purpose::other, std::span(rays),
                     vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eShaderDeviceAddress);
    uploader.finish();
    SceneAddresses addresses = scene_addresses(scene);
    enter_film(addresses, film);
    addresses.recorded_rays = ray_buffer.address;
    addresses.grouped_geometries = bottom.grouped_geometries.address;
    const PipelineLayout layout = make_pipeline_layout(gpu);
    const vk::raii::PipelineCache cache = open_pipeline_cache(gpu, {});
    const bool alpha = (packed.features & shared::FEATURE_ALPHA) != 0;
    const PipelineConstants specialised{.features = packed.features, .groups = groups.groups.empty() ? 0U : 1U};
    const PipelineShaders shaders = scene_shaders(test_shader_binary("trace_rays.rgen"), alpha);
    const TracePipeline pipeline =
        with_table(gpu, compile_trace_shaders(gpu, layout, cache, shaders, specialised));
    const Bindings bindings = make_bindings(gpu, layout, {.scene = *top.structure}, addresses, packed.constants);
    run_commands(gpu, [&](Recorder& recorder) {
        record_dispatch(recorder, pipeline, layout, bindings, {}, static_cast<std::uint32_t>(rays.size()), 1);
    });
    const Film host = read_film(gpu, film);
    std::vector<TracedRay> traced;
    for (const shared::FilmFirstHit& result : host.first_hits) {
        traced.push_back({.hit = {.instance = result.albedo.low.x,
                                  .geometry = result.albedo.low.y,
                                  .primitive = result.albedo.low.z,
                                  .barycentrics = {std::bit_cast<float>(result.normal.low.x),
                                                   std::bit_cast<float>(result.normal.low.y)},
                                  .t = std::bit_cast<float>(result.normal.low.z)},
                          .blocked = result.depth.base != 0});
    }
    return traced;
}

PackedScene generated_scene(const std::string& name, const RenderSettings& settings) {
    return pack_scene(generate_scene(name).scene, settings);
}

void add_geometry(PackedScene& packed, const std::vector<shared::vec3>& positions,
                  const std::vector<shared::uvec3>& triangles, std::uint32_t material) {
    shared::Geometry geometry{};
    geometry.first_triangle = static_cast<std::uint32_t>(packed.triangles.size());
    geometry.first_vertex = static_cast<std::uint32_t>(packed.positions.size());
    geometry.first_normal = geometry.first_tangent = geometry.first_color = shared::NONE;
    geometry.first_uv_0 = geometry.first_uv_1 = shared::NONE;
    geometry.material = material;
    packed.geometries.push_back(geometry);
    const bool alpha =
        (packed.materials[material].flags & (shared::MATERIAL_ALPHA_MASK | shared::MATERIAL_ALPHA_BLEND)) != 0;
    packed.geometry_extents.push_back({.triangle_count = static_cast<std::uint32_t>(triangles.size()),
                                       .vertex_count = static_cast<std::uint32_t>(positions.size()),
                                       .alpha = alpha});
    packed.positions.insert(packed.positions.end(), positions.begin(), positions.end());
    packed.triangles.insert(packed.triangles.end(), triangles.begin(), triangles.end());
    ++packed.meshes.back().geometry_count;
}

void add_instance(PackedScene& packed, std::uint32_t mesh, const glm::mat4x3& m) {
    shared::Instance instance{};
    instance.row_0 = {m[0][0], m[1][0], m[2][0], m[3][0]};
    instance.row_1 = {m[0][1], m[1][1], m[2][1], m[3][1]};
    instance.row_2 = {m[0][2], m[1][2], m[2][2], m[3][2]};
    instance.first_geometry = packed.meshes[mesh].first_geometry;
    instance.first_emitter_slot = shared::NONE;
    instance.mirrored = glm::determinant(glm::mat3(m)) < 0 ? 1 : 0;
    packed.instances.push_back(instance);
    packed.instance_meshes.push_back(mesh);
}

PackedScene random_scene(std::uint32_t seed, std::uint32_t meshes, std::uint32_t instances, std::uint32_t triangles) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    const auto point = [&] {
        const float x = uniform(random);
        const float y = uniform(random);
        const float z = uniform(random);
        return shared::vec3(x, y, z);
    };
    PackedScene packed;
    shared::Material material{};
    material.base_color = shared::vec4(0.5F, 0.5F, 0.5F, 1.0F);
    material.base_color_slot = material.metallic_roughness_slot = material.normal_slot = shared::NONE;
    material.emission_slot = material.specular_slot = material.specular_color_slot = shared::NONE;
    packed.materials.push_back(material);
    for (std::uint32_t mesh = 0; mesh < meshes; ++mesh) {
        packed.meshes.push_back(
            {.first_geometry = static_cast<std::uint32_t>(packed.geometries.size()), .geometry_count = 0});
        for (std::uint32_t geometry = 0; geometry < 1 + mesh % 3; ++geometry) {
            std::vector<shared::vec3> positions;
            std::vector<shared::uvec3> indices;
            for (std::uint32_t i = 0; i < triangles; ++i) {
                const shared::vec3 center = point();
                for (int k = 0; k < 3; ++k) {
                    positions.push_back(center + 0.3F * point());
                }
                // Backwards, so that an index that is not relative to its geometry cannot go unseen.
                const std::uint32_t last = 3 * (triangles - 1 - i);
                indices.push_back({last + 2, last, last + 1});
            }
            add_geometry(packed, positions, indices, 0);
        }
    }
    for (std::uint32_t i = 0; i < instances; ++i) {
        glm::mat4x3 m(1.0F);
        for (int column = 0; column < 3; ++column) {
            m[column] = m[column] + 0.4F * point();
            m[column] = m[column] * (1.0F + 0.5F * uniform(random));
        }
        m[0] = i % 2 == 1 ? -m[0] : m[0];
        m[3] = 2.0F * point();
        add_instance(packed, i % meshes, m);
    }
    packed.constants.size = {16, 16};
    return packed;
}

}  // namespace diptych::core::tests
